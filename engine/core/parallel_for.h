#pragma once

#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace meltpoint {

/// Calls body(i) for every i in [0, count) on all cores. The body must write only to places that belong to i: then the
/// result does not depend on the thread count.
template <class Body>
void parallel_for(std::size_t count, const Body& body)
{
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            body(i);
        }
    });
}

} // namespace meltpoint
