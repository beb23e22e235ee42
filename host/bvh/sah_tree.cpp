#include <embree3/rtcore.h>

#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "host/bvh/tree.h"
#include "host/error.h"

namespace meniscal {
namespace {

template <auto release>
struct Release {
  template <class Handle>
  void operator()(Handle handle) const {
    release(handle);
  }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release<rtcReleaseDevice>>;
using EmbreeBvh = std::unique_ptr<std::remove_pointer_t<RTCBVH>, Release<rtcReleaseBVH>>;

void* create_node(RTCThreadLocalAllocator, unsigned, void* nodes) { return static_cast<TreeNodes*>(nodes)->make(); }

void set_children(void* node, void** children, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i)
    static_cast<TreeNode*>(node)->child[i] = static_cast<const TreeNode*>(children[i]);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i) {
    const RTCBounds& b = *bounds[i];
    static_cast<TreeNode*>(node)->box[i] = {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
  }
}

void* create_leaf(RTCThreadLocalAllocator, const RTCBuildPrimitive* primitives, size_t count, void* nodes) {
  TreeNode* const leaf = static_cast<TreeNodes*>(nodes)->make();
  leaf->count = static_cast<uint32_t>(count);
  for (size_t i = 0; i < count; ++i) leaf->triangles[i] = primitives[i].primID;
  return leaf;
}

}  // namespace

const TreeNode* build_sah_tree(std::span<const Box> boxes, uint32_t max_depth, TreeNodes& nodes) {
  std::vector<RTCBuildPrimitive> primitives;
  primitives.reserve(boxes.size());
  for (size_t i = 0; i < boxes.size(); ++i) {
    const auto& [low, high] = boxes[i];
    primitives.push_back({low.x, low.y, low.z, 0, high.x, high.y, high.z, static_cast<unsigned>(i)});
  }
  // One thread: the order of what several finish would leak into the tree.
  const Device device(rtcNewDevice("threads=1"));
  if (!device)
    throw Error(ExitCode::failed, "Embree could not start: error " + std::to_string(rtcGetDeviceError(nullptr)));
  const EmbreeBvh bvh(rtcNewBVH(device.get()));

  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
  arguments.maxBranchingFactor = 2;
  arguments.maxDepth = max_depth;
  // A step of the tracers fetches one record, node or triangle: both cost 1. Leaves of up to 4 then take as few steps a
  // ray as of 1 or 2, within 1 %, or fewer (measured on sheets, soups and slivers), and half the memory.
  arguments.traversalCost = arguments.intersectionCost = 1;
  arguments.maxLeafSize = shared::BVH_MAX_LEAF;
  arguments.bvh = bvh.get();
  arguments.primitives = primitives.data();
  arguments.primitiveCount = arguments.primitiveArrayCapacity = primitives.size();
  arguments.createNode = create_node;
  arguments.setNodeChildren = set_children;
  arguments.setNodeBounds = set_bounds;
  arguments.createLeaf = create_leaf;
  arguments.userPtr = &nodes;
  const void* const root = rtcBuildBVH(&arguments);
  if (rtcGetDeviceError(device.get()) == RTC_ERROR_OUT_OF_MEMORY) {
    throw Error(ExitCode::failed, "out of memory while building the hierarchy of " + std::to_string(boxes.size()) +
                                      " triangles; use a machine with more, or a smaller scene");
  }
  return static_cast<const TreeNode*>(root);  // null: Embree's depth limit was reached
}

}  // namespace meniscal
