/// @file
/// The cache of this user: where it is and how large it may grow.
#pragma once

#include <cstdint>
#include <memory>

#include "output/cache/result_cache.h"

namespace meshfolio::run {

/// [bytes]; MESHFOLIO_CACHE_LIMIT in the environment is in megabytes. @throws UsageError for what is no number from 1 to 1000000
std::uintmax_t cache_limit();

/// The cache in its default folder; null, with a warning, where it cannot be used: a report is made without.
std::unique_ptr<output::ResultCache> usable_cache();

}   // namespace meshfolio::run
