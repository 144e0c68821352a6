#pragma once

#include <glm/glm.hpp>

#include "core/aabb.h"
#include "geometry/cell_grid.h"

namespace meltpoint {

/// A region of space that can be filled with particles: it knows which points it contains. Safe to query from several
/// threads.
class Solid {
public:
    Solid() = default;
    Solid(const Solid&) = delete;
    Solid& operator=(const Solid&) = delete;
    virtual ~Solid() = default;

    /// Contains all of the solid (m).
    [[nodiscard]] virtual Aabb bounds() const = 0;

    /// m^3, 0 where nothing is inside. Where it has to be measured, the first call is the costly one.
    [[nodiscard]] virtual double volume() const = 0;

    /// Whether a point (m) lies inside; on the surface, either may be the answer.
    [[nodiscard]] virtual bool contains(const glm::dvec3& point) const = 0;

    /// The points of a grid that the solid contains; some solids can tell more cheaply than point by point.
    [[nodiscard]] virtual CellMask mask(const CellGrid& grid) const;
};

/// An axis-aligned box.
class BoxSolid final : public Solid {
public:
    /// The box in m.
    explicit BoxSolid(const Aabb& box) : box_(box) {}

    [[nodiscard]] Aabb bounds() const override { return box_; }
    [[nodiscard]] double volume() const override;
    /// @copydoc Solid::contains
    [[nodiscard]] bool contains(const glm::dvec3& point) const override;

private:
    Aabb box_;
};

/// A ball.
class BallSolid final : public Solid {
public:
    /// Radius in m.
    BallSolid(const glm::vec3& center, float radius) : center_(center), radius_(radius) {}

    [[nodiscard]] Aabb bounds() const override;
    [[nodiscard]] double volume() const override;
    /// @copydoc Solid::contains
    [[nodiscard]] bool contains(const glm::dvec3& point) const override;

private:
    glm::dvec3 center_;
    double radius_;
};

} // namespace meltpoint
