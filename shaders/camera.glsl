// Where camera paths start. Is included after optics.glsl.

FETCH_TABLE(BIND_VIEW, view)

// A camera path's start through a place in pixels, from the image's upper left corner.
Path camera_path(vec2 pixel) {
  vec3 right = uintBitsToFloat(FETCH(view, 0u).xyz), up = uintBitsToFloat(FETCH(view, 1u).xyz);
  uvec4 axis = FETCH(view, 2u), eye = FETCH(view, 3u);
  vec2 size = vec2(FETCH(view, 4u).xy);
  vec3 offset = (2.0 * pixel.x / size.x - 1.0) * right + (1.0 - 2.0 * pixel.y / size.y) * up;
  vec3 origin = uintBitsToFloat(eye.xyz), forward = uintBitsToFloat(axis.xyz);
  bool orthographic = eye.w != 0u;
  if (orthographic) origin += offset;
  else forward += offset;
  Path path = start_path(origin, normalize(forward), NO_TRIANGLE, vec3(1.0));
  if (HAS_NESTED) be_in(path, FETCH(view, 6u));
  if (HAS_DIFFERENTIALS)
    path.differential = camera_differential(2.0 / size.x * right, -2.0 / size.y * up, path.direction, length(forward), orthographic);
  return path;
}
