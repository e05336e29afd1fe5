/// @file
/// Where the neighbours of a vertex stand in its row of a matrix, for the nearly all whose triangles form one closed fan.
#pragma once

#include "geometry/operators/corner_batch.h"

namespace meshfolio {

/// Fills place_of_next, place_of_previous and diagonal_place of a batch that has its sides.
void find_closed_fans(CornerBatch& batch);

}   // namespace meshfolio
