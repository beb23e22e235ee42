// Surfaces at a point.
#include "textures.glsl"

// What the surface is there; `point.shading` as its textures bend it.
Surface shade(inout SurfacePoint point) {
  Surface s = fetch_surface(point.material);
  if (TEXTURES != 0u && s.textures != 0u) s = with_textures(s, point);
  return s;
}
