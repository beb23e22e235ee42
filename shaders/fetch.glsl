// Read-mostly tables. Texel buffers are fastest on lavapipe (measured); devices that hold too few texels use storage buffers
// (compiled with FETCH_STORAGE). Elements are 16 bytes (pairs: 8, words: 4), read as bits so that no reference passes for a float.
#ifdef FETCH_STORAGE
#define FETCH_TABLE(slot, name) \
  layout(set = 0, binding = slot, std430) readonly buffer Table##name { uvec4 table_##name[]; };
#define FETCH(name, i) table_##name[i]
#define FETCH_PAIRS(slot, name) \
  layout(set = 0, binding = slot, std430) readonly buffer Table##name { uvec2 table_##name[]; };
#define FETCH_PAIR(name, i) table_##name[i]
#define FETCH_WORDS(slot, name) \
  layout(set = 0, binding = slot, std430) readonly buffer Table##name { uint table_##name[]; };
#define FETCH_WORD(name, i) table_##name[i]
#else
#define FETCH_TABLE(slot, name) layout(set = 0, binding = slot) uniform usamplerBuffer table_##name;
#define FETCH(name, i) texelFetch(table_##name, int(i))
#define FETCH_PAIRS FETCH_TABLE
#define FETCH_PAIR(name, i) FETCH(name, i).xy
#define FETCH_WORDS FETCH_TABLE
#define FETCH_WORD(name, i) FETCH(name, i).x
#endif

// All passes run in workgroups of 64.
layout(local_size_x = 64) in;

// Invocation's place in a dispatch, whose workgroups may spread over two dimensions.
uint invocation_index() {
  return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
}
