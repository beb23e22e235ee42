// Binding numbers of descriptor set 0, by shader. Included by the passes and their shaders.
#ifndef MENISCAL_BINDINGS_H
#define MENISCAL_BINDINGS_H

// Scene tables, alike in every pass that traces rays.
#define BIND_SCENE 0        // texels: BVH nodes, then triangle records, 4 texels each
#define BIND_NORMALS 1      // texels: 3 a triangle, shading normals of its corners
#define BIND_SURFACES 2     // texels: Surface[], by material
#define BIND_LIGHTS 3       // texels: Light[]
#define BIND_CDF 4          // texels: uint[], cumulative probabilities of targets and lights, scaled to 2^32
#define BIND_TARGETS 5      // texels: uint[], triangles, beside their part of the CDF
#define BIND_COUNTERS 6     // uint[COUNTERS]
#define BIND_ENVIRONMENT 7  // texels: radiance by pixel and the density of directions that are sampled there
#define BIND_TEXTURES 8     // texels: see host/passes/texture_tables.h
#define BIND_IMAGES 9       // words
#define BIND_OUTPUT 10      // first binding of a pass's own

// Of shaders/paths.comp.
#define BIND_ENDS 10
#define BIND_DISCS 11
#define BIND_SAMPLES 12
#define BIND_BEAMS 13     // texels: Beam[]
#define BIND_VIEW 14      // texels: one CameraView
#define BIND_ARRIVALS 15  // uint[], see pack_direction
#define BIND_GLOSS 16     // PixelGloss[]

// Of shaders/highlights.comp, which has BIND_VIEW, too.
#define BIND_LISTED 10      // uint[]: pixels of the crop
#define BIND_HIGHLIGHTS 11  // vec4[]: radiance

#endif
