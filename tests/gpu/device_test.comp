// Everything that a pass can be given, in one small shader: see device_compute_test.cpp.
#version 460

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint SCALE = 0;
layout(constant_id = 1) const bool ADD_BITS = false;
layout(constant_id = 2) const float FACTOR = 0.0;
layout(set = 0, binding = 0) uniform samplerBuffer numbers;
layout(set = 0, binding = 1) uniform usamplerBuffer bits;
layout(set = 0, binding = 2, std430) buffer Values { uint values[]; };
layout(push_constant) uniform Push {
  uint count;
  uint offset;
};

void main() {
  uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  uint i = group * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
  if (i >= count) return;
  uint value = values[i] * SCALE + offset + uint(FACTOR * texelFetch(numbers, int(i % 4u)).z);
  if (ADD_BITS) value += texelFetch(bits, int(i % 4u)).y;
  values[i] = value;
}
