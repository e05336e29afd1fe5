/// @file
/// What every tag of the templates stands for, as the view model says itself.
#pragma once

#include <map>
#include <string>

namespace meshfolio::report {

/// By its path in the view model, "sections.blocks.caption": what stands there. Lists and conditions are named like the values in them.
std::map<std::string, std::string> tag_list();

/// The same as text for people, one line a tag.
std::string tag_documentation();

}   // namespace meshfolio::report
