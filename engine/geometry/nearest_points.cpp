#include "geometry/nearest_points.h"

#include <nanoflann.hpp>

namespace meltpoint {

namespace {

/// What nanoflann asks of a container, in its own names.
struct PointSource {
    std::span<const glm::vec3> points;

    [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
    [[nodiscard]] float kdtree_get_pt(std::size_t i, std::size_t axis) const
    {
        return points[i][static_cast<glm::length_t>(axis)];
    }
    template <class Box>
    bool kdtree_get_bbox(Box& /*box*/) const
    {
        return false; // it shall find out itself
    }
};

} // namespace

class NearestPoints::Tree {
public:
    explicit Tree(std::span<const glm::vec3> points) : source_{points}, index_(3, source_) {}

    [[nodiscard]] std::vector<std::uint32_t> of(std::uint32_t point, std::size_t count) const
    {
        std::vector<std::uint32_t> found(count + 1); // it finds the point too
        std::vector<double> squares(count + 1);
        const glm::vec3& position = source_.points[point];
        found.resize(index_.knnSearch(&position.x, count + 1, found.data(), squares.data()));
        if (std::erase(found, point) == 0 && !found.empty()) {
            found.pop_back(); // crowded out by others at the same place
        }
        return found;
    }

    [[nodiscard]] std::uint32_t nearest_to(const glm::vec3& place) const
    {
        std::uint32_t found = 0;
        double square = 0.0;
        index_.knnSearch(&place.x, 1, &found, &square);
        return found;
    }

private:
    using Distance = nanoflann::L2_Simple_Adaptor<float, PointSource, double, std::uint32_t>;

    PointSource source_;
    nanoflann::KDTreeSingleIndexAdaptor<Distance, PointSource, 3, std::uint32_t> index_;
};

NearestPoints::NearestPoints(std::span<const glm::vec3> points) : tree_(std::make_unique<const Tree>(points)) {}

NearestPoints::~NearestPoints() = default;

std::vector<std::uint32_t> NearestPoints::of(std::uint32_t point, std::size_t count) const
{
    return tree_->of(point, count);
}

std::uint32_t NearestPoints::nearest_to(const glm::vec3& place) const
{
    return tree_->nearest_to(place);
}

} // namespace meltpoint
