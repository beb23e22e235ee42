// Dielectrics that lie in each other, by priority: Schmidt and Budge, "Simple Nested Dielectrics in Ray Traced Images",
// JGT 2002. What a path crosses, it keeps count of; here is what cameras and lights are in.
#pragma once

#include <span>

#include "host/world/world.h"

namespace meniscal {

// Where volumes overlap, the higher wins: what the material says, else 10, but for liquids 0.
int dielectric_priority(const Material& material);

// Sets the ranks of those that are dielectrics. `priorities`: by surface; of equal ones the later surface wins.
void rank_dielectrics(std::span<shared::Surface> surfaces, std::span<const int> priorities);

// Notes what an object fills, if it is of a dielectric. `raised`: of a liquid, its surface with its menisci.
void add_volume(World& world, const Object& object, std::uint32_t surface, const meniscus::TriangleMesh* raised);

// The triangles of a liquid's surface inside solids that lie in one of the world's dielectrics.
meniscus::TriangleMesh keep_seen(const World& world, meniscus::TriangleMesh within);

// Finds which volumes lie in each other, and what the lights are in.
void find_media(World& world);

// The dielectrics that a point is inside of, as shared::medium_of. Throws Error(ExitCode::scene) where they are too
// many.
glm::uvec4 media_at(const World& world, const glm::dvec3& point);

// Why paths must keep count of their media, if they must: some lie in each other, or they start in one that absorbs.
std::string why_nested(const World& world, const glm::uvec4& camera_media);

}  // namespace meniscal
