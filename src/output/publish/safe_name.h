#pragma once

#include <string_view>

namespace meshfolio::output {

/// True for a plain file name: 1 to 120 characters of [A-Za-z0-9_.+-], the first of which is no point and no minus.
bool is_safe_name(std::string_view name);

}   // namespace meshfolio::output
