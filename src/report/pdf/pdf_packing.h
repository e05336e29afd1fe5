/// @file
/// A PDF made smaller: what is no stream is compressed, a hundred objects at a time (ISO 32000-1, 7.5.7 and 7.5.8).
#pragma once

#include <string>
#include <string_view>

namespace meshfolio::report {

/// Objects keep their numbers. libqpdf, which orders a packed file by the numbers of another, takes twice the time for it.
/// @param pdf  as libqpdf writes it without object streams, of version 1.5 at least
/// @throws EngineError if it is not
std::string packed_pdf(std::string_view pdf);

}   // namespace meshfolio::report
