/// @file
/// Short names of the elements of diagrams, for `using namespace diagram_names;`.
#pragma once

#include "report/diagram.h"

namespace meshfolio::diagram_names {

using report::Diagram;
using report::DiagramPoint;
using report::math;
using report::path_through;
using report::text;
using Style = report::Diagram::Style;
using Side = report::Diagram::Side;

}   // namespace meshfolio::diagram_names
