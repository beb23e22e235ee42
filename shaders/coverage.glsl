// Areas and centroids of polygons inside the unit square, edge by edge.

// What a closed polygon covers of the unit square: the sum over its edges, in order, of what lies between them and the square's bottom.
// Clockwise polygons have positive areas.
struct Coverage {
  float area;
  vec2 moment;  // centroid * area
};

void add_edge(inout Coverage c, vec2 a, vec2 b) {
  vec2 along = b - a;
  if (along.x == 0.0) return;
  // Beyond the left and the right side nothing lies below the edge; beyond the bottom and the top it runs along them.
  float left = -a.x / along.x, right = (1.0 - a.x) / along.x;
  float first = clamp(min(left, right), 0.0, 1.0), last = clamp(max(left, right), 0.0, 1.0);
  float bottom = last, top = last;
  if (along.y != 0.0) {
    bottom = clamp(-a.y / along.y, first, last);
    top = clamp((1.0 - a.y) / along.y, first, last);
  }
  vec4 bends = vec4(first, min(bottom, top), max(bottom, top), last);
  for (int i = 0; i < 3; ++i) {
    vec2 p = clamp(a + bends[i] * along, 0.0, 1.0), q = clamp(a + bends[i + 1] * along, 0.0, 1.0);
    float width = q.x - p.x;
    c.area += width * (p.y + q.y) * 0.5;
    c.moment.x += width * (p.x * (2.0 * p.y + q.y) + q.x * (p.y + 2.0 * q.y)) / 6.0;
    c.moment.y += width * (p.y * p.y + p.y * q.y + q.y * q.y) / 6.0;
  }
}
