#include "geometry/sample_elimination.h"

#include <algorithm>
#include <cmath>

#include "core/parallel_for.h"
#include "geometry/point_cells.h"

namespace meltpoint {

namespace {

constexpr double beta = 0.65;
constexpr double gamma = 1.5;
constexpr float opposite = -0.7f; // cosine between normals

/// A binary heap of items 0 ... n-1 with the heaviest on top; of equal ones the first.
class HeaviestFirst {
public:
    explicit HeaviestFirst(std::span<const float> weights) : heap_(weights.size()), place_(weights.size())
    {
        for (std::uint32_t item = 0; item < heap_.size(); ++item) {
            put(item, {weights[item], item});
        }
        for (std::size_t i = heap_.size() / 2; i-- > 0;) {
            sink(i);
        }
    }

    [[nodiscard]] std::size_t size() const { return heap_.size(); }
    [[nodiscard]] bool contains(std::uint32_t item) const { return place_[item] != gone; }

    std::uint32_t pop()
    {
        const std::uint32_t item = heap_.front().item;
        put(0, heap_.back());
        heap_.pop_back();
        place_[item] = gone;
        if (!heap_.empty()) {
            sink(0);
        }
        return item;
    }

    void lighten(std::uint32_t item, float weight)
    {
        heap_[place_[item]].weight -= weight;
        sink(place_[item]);
    }

private:
    static constexpr std::uint32_t gone = UINT32_MAX;

    struct Entry {
        float weight;
        std::uint32_t item;

        [[nodiscard]] bool before(const Entry& other) const
        {
            return weight != other.weight ? weight > other.weight : item < other.item;
        }
    };

    void put(std::size_t place, const Entry& entry)
    {
        heap_[place] = entry;
        place_[entry.item] = static_cast<std::uint32_t>(place);
    }

    void sink(std::size_t place)
    {
        const Entry entry = heap_[place];
        for (;;) {
            std::size_t child = 2 * place + 1;
            if (child >= heap_.size()) {
                break;
            }
            child += child + 1 < heap_.size() && heap_[child + 1].before(heap_[child]) ? 1 : 0;
            if (!heap_[child].before(entry)) {
                break;
            }
            put(place, heap_[child]);
            place = child;
        }
        put(place, entry);
    }

    std::vector<Entry> heap_;
    std::vector<std::uint32_t> place_; ///< of each item in the heap
};

/// What each candidate sees (equations 1 and 2 of the paper).
class Sight {
public:
    Sight(const EliminationInput& input, const PointCells& cells)
        : cells_(cells), spacing_(static_cast<float>(input.spacing)), points_(input.points.size()),
          two_sided_(!input.normals.empty())
    {
        const double kept =
            static_cast<double>(input.keep) / static_cast<double>(std::max<std::size_t>(points_.size(), 1));
        nearest_ = static_cast<float>(input.spacing * (1.0 - std::pow(std::min(kept, 1.0), gamma)) * beta); // 2 r_min
        parallel_for(points_.size(), [&](std::size_t place) {
            const std::uint32_t point = cells.order()[place];
            points_[place] = {input.points[point], two_sided_ ? input.normals[point] : glm::vec3(0.0f)};
        });
    }

    /// Calls see(place, weight) for all points that the one at a place sees, of those that are wanted.
    template <class Wanted, class See>
    void from(std::uint32_t place, const Wanted& wanted, const See& see) const
    {
        const Point point = points_[place];
        cells_.visit_near(place, [&](std::uint32_t other) {
            if (other == place || !wanted(other)) {
                return;
            }
            const glm::vec3 gap = points_[other].position - point.position;
            const float r2 = glm::dot(gap, gap);
            if (r2 >= spacing_ * spacing_ || (two_sided_ && glm::dot(point.normal, points_[other].normal) < opposite)) {
                return;
            }
            const float closeness = 1.0f - std::max(std::sqrt(r2), nearest_) / spacing_;
            const float squared = closeness * closeness;
            const float fourth = squared * squared;
            see(other, fourth * fourth); // alpha 8
        });
    }

private:
    struct Point {
        glm::vec3 position;
        glm::vec3 normal;
    };

    const PointCells& cells_;
    float spacing_;
    float nearest_ = 0.0f;
    std::vector<Point> points_; ///< in the order of the cells
    bool two_sided_;
};

} // namespace

std::vector<std::uint32_t> eliminate_samples(const EliminationInput& input)
{
    const PointCells cells(input.points, input.spacing);
    const Sight sight(input, cells);
    std::vector<float> weights(input.points.size(), 0.0f);
    parallel_for(weights.size(), [&](std::size_t place) {
        const auto all = [](std::uint32_t) {
            return true;
        };
        sight.from(static_cast<std::uint32_t>(place), all,
                   [&](std::uint32_t, float weight) { weights[place] += weight; });
    });

    HeaviestFirst heap(weights);
    const auto there = [&](std::uint32_t place) {
        return heap.contains(place);
    };
    const auto remove_heaviest = [&] {
        const std::uint32_t heaviest = heap.pop();
        sight.from(heaviest, there, [&](std::uint32_t other, float weight) { heap.lighten(other, weight); });
        return heaviest;
    };
    std::vector<std::uint8_t> counts(input.points.size(), 1);
    std::size_t left = counts.size();
    if (input.counts) {
        while (heap.size() > std::max(input.look_at, input.keep)) {
            remove_heaviest();
        }
        parallel_for(counts.size(), [&](std::size_t place) {
            counts[place] = heap.contains(static_cast<std::uint32_t>(place)) && input.counts(cells.order()[place]);
        });
        left = static_cast<std::size_t>(std::count(counts.begin(), counts.end(), 1));
    }
    while (left > input.keep) {
        left -= counts[remove_heaviest()];
    }

    std::vector<std::uint32_t> kept;
    for (std::uint32_t place = 0; place < input.points.size(); ++place) {
        if (heap.contains(place) && counts[place] != 0) {
            kept.push_back(cells.order()[place]);
        }
    }
    std::sort(kept.begin(), kept.end());
    return kept;
}

} // namespace meltpoint
