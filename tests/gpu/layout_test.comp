#version 460
#extension GL_GOOGLE_include_directive : require
// Fills one of each shared struct with 1, 2, 3, ... in the order of its members: the host checks where they landed.
#include "shared/structs.h"
#include "shared/textures.h"

layout(local_size_x = 1) in;
layout(set = 0, binding = 0, std430) writeonly buffer A { Surface surfaces[]; };
layout(set = 0, binding = 1, std430) writeonly buffer B { Light lights[]; };
layout(set = 0, binding = 2, std430) writeonly buffer C { PhotonEnd ends[]; };
layout(set = 0, binding = 3, std430) writeonly buffer D { PhotonDisc discs[]; };
layout(set = 0, binding = 4, std430) writeonly buffer E { PixelSample samples[]; };
layout(set = 0, binding = 5, std430) writeonly buffer F { MaterialTextures materials[]; };
layout(set = 0, binding = 6, std430) writeonly buffer G { Texture textures[]; };

void main() {
  // The second element, so that the stride counts too.
  surfaces[1] = Surface(vec3(1, 2, 3), 4, vec3(5, 6, 7), 8, vec3(9, 10, 11), 12u, vec3(13, 14, 15), 16u, 17u, 18u, 19, 20u, vec3(21, 22, 23), 24);
  lights[1] = Light(vec3(1, 2, 3), 4u, vec3(5, 6, 7), 8, vec3(9, 10, 11), 12u, vec3(13, 14, 15), 16, vec3(17, 18, 19), 20u, 21, 22, 23, 24, uvec4(25, 26, 27, 28));
  ends[1] = PhotonEnd(vec3(1, 2, 3), 4u, 5, 6, 7, 8u);
  discs[1] = PhotonDisc(vec3(1, 2, 3), 4, vec3(5, 6, 7), 8, vec3(9, 10, 11), 12);
  samples[1] = PixelSample(vec3(1, 2, 3), 4, vec3(5, 6, 7), 8, vec3(9, 10, 11), 12u, vec3(13, 14, 15), 16, vec3(17, 18, 19), 20,
                           vec3(21, 22, 23), 24, vec3(25, 26, 27), 28, vec3(29, 30, 31), 32, vec3(33, 34, 35), 36);
  materials[1] = MaterialTextures(1u, 2u, 3u, 4u, 5, 6, 7, 8);
  textures[1] = Texture(vec3(1, 2, 3), 4u, vec3(5, 6, 7), 8u, 9u, 10u, 11u, 12u);
}
