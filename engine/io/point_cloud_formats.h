#pragma once

#include "geometry/point_cloud.h"
#include "io/atomic_file.h"
#include "io/row_writer.h"

namespace meltpoint {

// The formats of export_point_cloud, which see there. Each returns false where the rows were stopped.

bool write_ply(AtomicFile& file, RowWriter& rows, const PointCloud& cloud);
bool write_msh(AtomicFile& file, RowWriter& rows, const PointCloud& cloud);
bool write_vtp(AtomicFile& file, RowWriter& rows, const PointCloud& cloud);
bool write_xyz(AtomicFile& file, RowWriter& rows, const PointCloud& cloud);

} // namespace meltpoint
