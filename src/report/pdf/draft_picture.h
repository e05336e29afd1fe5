/// @file
/// A picture that takes the room of another and shows nothing: what a page needs to be laid out and not yet to be read.
#pragma once

#include <string>

namespace meshfolio::report {

/// A JPEG without what is drawn: decoders see its size and a grey area. What is no JPEG stays as it is.
std::string draft_of_jpeg(const std::string& jpeg);

}   // namespace meshfolio::report
