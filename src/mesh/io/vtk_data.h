/// @file
/// The arrays of VTK's XML files, as VTK and ParaView write them.
#pragma once

#include <pugixml.hpp>

#include <string>
#include <string_view>
#include <vector>

#include "mesh/io/scalar_type.h"

namespace meshfolio {

struct VtkArray {
    std::vector<double> values;   // whole numbers are exact up to 2⁵³
    int components = 1;
    ScalarType type = ScalarType::float64;
};

/// A file: its XML, and the data behind it.
class VtkFile {
public:
    /// @throws InputError if the bytes are no XML of VTK, or use another compression than zlib
    VtkFile(std::string_view bytes, std::string file);

    pugi::xml_node root() const { return root_; }

    /// Returns the values of a DataArray: text, or binary data in the element or behind the XML, packed by zlib or not.
    /// @throws InputError naming the array
    VtkArray array(const pugi::xml_node& element);

private:
    [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;
    std::string data_of(std::string_view encoded, bool is_text, const std::string& name);

    std::string file_;
    pugi::xml_document document_;
    pugi::xml_node root_;
    std::string_view appended_;
    std::size_t left_;   // bytes that arrays may still take: small files could claim any amount
    bool appended_is_text_ = false, swapped_ = false, is_packed_ = false;
    ScalarType header_ = ScalarType::uint32;   // type of the sizes in front of data
};

}   // namespace meshfolio
