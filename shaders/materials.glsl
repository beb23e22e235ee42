// Surfaces at a point.
#include "scene.glsl"
#include "shared/material.h"

// What the surface is there; `point.shading` as its textures bend it.
Surface shade(inout SurfacePoint point) { return fetch_surface(point.material); }
