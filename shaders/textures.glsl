// Textures at a point: the material's own, and those of a light.
#include "scene.glsl"
#include "shared/textures.h"

FETCH_TABLE(BIND_TEXTURES, textures)
FETCH_WORDS(BIND_IMAGES, images)

layout(constant_id = 20) const uint TEXTURES = 31u;  // TEXTURE_* that the scene's materials have

// Texture coordinates of both sets, and how they change along a triangle's edges.
struct TexturePlace {
  vec4 at, ab, ac;
};

TexturePlace texture_place(uint coordinates, vec2 weights) {
  vec4 a = uintBitsToFloat(FETCH(textures, coordinates)), b = uintBitsToFloat(FETCH(textures, coordinates + 1u));
  vec4 c = uintBitsToFloat(FETCH(textures, coordinates + 2u));
  if (coordinates == 0u) a = b = c = vec4(0.0);
  return TexturePlace(a + weights.x * (b - a) + weights.y * (c - a), b - a, c - a);
}

Texture fetch_texture(uint texel) {
  uvec4 a = FETCH(textures, texel), b = FETCH(textures, texel + 1u), c = FETCH(textures, texel + 2u);
  return Texture(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w, c.x, c.y, 0u, 0u);
}

// The texture's own of two sets of coordinates.
vec2 of_set(Texture texture, vec4 both) { return (texture.reading & READS_SECOND_SET) == 0u ? both.xy : both.zw; }

// Into [0, 1]: neighbours of what lies there are then in the image, or just beyond its border.
float fold(float x, uint wrap) {
  float twice = x - 2.0 * floor(0.5 * x);
  return wrap == WRAP_REPEAT ? x - floor(x) : wrap == WRAP_MIRROR ? 1.0 - abs(1.0 - twice) : clamp(x, 0.0, 1.0);
}
ivec2 neighbours(float left, uint size, uint wrap) {
  int i = int(left), last = int(size) - 1;
  ivec2 both = ivec2(i, i + 1);
  if (wrap == WRAP_REPEAT) both = ivec2(i < 0 ? last : i, i >= last ? 0 : i + 1);
  return clamp(both, 0, last);  // a mirrored image's neighbour is its border; and no number leads out of the table
}

vec3 linear(vec3 encoded) {
  return mix(pow((encoded + 0.055) / 1.055, vec3(2.4)), encoded / 12.92, lessThanEqual(encoded, vec3(0.04045)));
}

vec4 fetch_image(Texture texture, int x, int y, bool srgb) {
  uint i = uint(y) * texture.width + uint(x);
  bool deep = (TEXTURES & TEXTURE_DEEP) != 0u && (texture.reading & READS_DEEP) != 0u;
  uint word = texture.first + (deep ? 2u * i : i);
  uint low = FETCH_WORD(images, word);
  vec4 color = unpackUnorm4x8(low);
  if (deep) color = vec4(unpackUnorm2x16(low), unpackUnorm2x16(FETCH_WORD(images, word + 1u)));
  return vec4(srgb ? linear(color.xyz) : color.xyz, color.w);
}

// `srgb`: its colours are encoded so, as a material's colours are; known when compiled, since decoding takes time.
vec4 look_up(Texture texture, vec4 coordinates, bool srgb) {
  vec3 at = vec3(of_set(texture, coordinates), 1.0);
  uint wrap_s = (texture.reading >> WRAP_S_SHIFT) & WRAP_MASK, wrap_t = (texture.reading >> WRAP_T_SHIFT) & WRAP_MASK;
  vec2 place = vec2(fold(dot(texture.s, at), wrap_s), fold(dot(texture.t, at), wrap_t)) * vec2(texture.width, texture.height);
  bool nearest = (texture.reading & READS_NEAREST) != 0u;
  if (!nearest) place -= 0.5;  // texels' centres lie at halves
  vec2 corner = floor(place), part = nearest ? vec2(0.0) : place - corner;
  ivec2 x = neighbours(corner.x, texture.width, wrap_s), y = neighbours(corner.y, texture.height, wrap_t);
  return mix(mix(fetch_image(texture, x.x, y.x, srgb), fetch_image(texture, x.y, y.x, srgb), part.x),
             mix(fetch_image(texture, x.x, y.y, srgb), fetch_image(texture, x.y, y.y, srgb), part.x), part.y);
}

// The shading normal as the texture tells it, in the frame of what its image shows to the right and upwards. Left as it is where
// the coordinates have no such frame; kept off the facet's plane.
vec3 bent_normal(SurfacePoint point, TexturePlace place, Texture texture, float scale) {
  vec3 told = (2.0 * look_up(texture, place.at, false).xyz - 1.0) * vec3(scale, scale, 1.0);
  vec2 b = of_set(texture, place.ab), c = of_set(texture, place.ac);
  vec2 s = vec2(dot(texture.s.xy, b), dot(texture.s.xy, c)), t = vec2(dot(texture.t.xy, b), dot(texture.t.xy, c));
  float determinant = s.x * t.y - s.y * t.x;
  vec3 right = (t.y * point.ab - t.x * point.ac) * sign(determinant);
  right -= point.shading * dot(point.shading, right);
  float length2 = dot(right, right);
  if (determinant == 0.0 || !(length2 > 0.0) || !(dot(told, told) > 1e-12)) return point.shading;
  right *= inversesqrt(length2);
  // The image's vertical runs downwards: unmirrored where the determinant is negative.
  vec3 up = cross(point.shading, right) * (determinant < 0.0 ? 1.0 : -1.0);
  vec3 normal = normalize(told.x * right + told.y * up + told.z * point.shading);
  return normalize(normal + point.geometric * max(LEAST_BENT_COSINE - dot(normal, point.geometric), 0.0));
}

Surface with_textures(Surface s, inout SurfacePoint point) {
  uvec4 of = FETCH(textures, 2u * (s.textures - 1u));
  vec4 factors = uintBitsToFloat(FETCH(textures, 2u * (s.textures - 1u) + 1u));
  TexturePlace place = texture_place(point.coordinates, point.weights);
  vec3 base = s.albedo;
  float metallic = factors.x, roughness = factors.y;
  if ((TEXTURES & TEXTURE_BASE) != 0u && of.x != 0u) base *= look_up(fetch_texture(of.x), place.at, true).xyz;
  if ((TEXTURES & TEXTURE_METALLIC_ROUGHNESS) != 0u && of.y != 0u) {
    vec4 told = look_up(fetch_texture(of.y), place.at, false);
    metallic *= told.z;
    roughness *= told.y;
  }
  if ((TEXTURES & TEXTURE_NORMAL) != 0u && of.z != 0u) point.shading = bent_normal(point, place, fetch_texture(of.z), factors.w);
  if ((TEXTURES & TEXTURE_EMISSIVE) != 0u && of.w != 0u) s.emission *= look_up(fetch_texture(of.w), place.at, true).xyz;
  return textured(s, base, metallic, max(roughness, factors.z));
}

// What the emissive texture of a light's triangle makes of its emission at a point.
vec3 emitted_part(uint triangle, vec2 weights) {
  if ((TEXTURES & TEXTURE_EMISSIVE) == 0u) return vec3(1.0);
  uint record = 4u * (TRIANGLE_BASE + triangle), set = FETCH(surfaces, 6u * FETCH(scene, record).w + 4u).w;
  if (set == 0u) return vec3(1.0);
  uint texture = FETCH(textures, 2u * (set - 1u)).w;
  if (texture == 0u) return vec3(1.0);
  return look_up(fetch_texture(texture), texture_place(FETCH(scene, record + 3u).w, weights).at, true).xyz;
}
