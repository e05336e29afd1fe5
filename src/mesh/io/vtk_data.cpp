#include "mesh/io/vtk_data.h"

#include <libdeflate.h>
#include <memory>
#include <optional>
#include <utility>

#include "base/base64.h"
#include "base/errors.h"
#include "base/in_quotes.h"
#include "mesh/io/polygon_list.h"
#include "mesh/io/text_scanner.h"

namespace meshfolio {

void VtkFile::fail(const std::string& problem, const std::string& remedy) const { throw InputError({file_, 0}, problem, remedy); }

VtkFile::VtkFile(std::string_view bytes, std::string file) : file_(std::move(file)), left_(50 * bytes.size() + (1 << 20)) {
    // The data behind "_" may be binary, which is no XML.
    const std::size_t end = bytes.find("<AppendedData"), begin = end == bytes.npos ? end : bytes.find('_', bytes.find('>', end));
    std::string text(bytes.substr(0, end));
    if (begin != bytes.npos) {
        appended_ = bytes.substr(begin + 1);
        appended_is_text_ = bytes.substr(end, begin - end).find("base64") != bytes.npos;
        text += "</VTKFile>";
    }
    const pugi::xml_parse_result parsed = document_.load_buffer(text.data(), text.size());
    root_ = document_.child("VTKFile");
    if (!parsed || !root_) fail("no XML of VTK: " + std::string(parsed.description()), "the file may be cut off");
    const std::string_view compressor = root_.attribute("compressor").value(), order = root_.attribute("byte_order").value();
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
        fail("packed by " + in_quotes(compressor), "write it with zlib or without compression");
    if (order != "LittleEndian" && order != "BigEndian") fail("unknown byte order " + in_quotes(order), "the file may be damaged");
    is_packed_ = !compressor.empty();
    swapped_ = (order == "BigEndian") != (std::endian::native == std::endian::big);
    if (root_.attribute("header_type").value() == std::string_view("UInt64")) header_ = ScalarType::uint64;
}

VtkArray VtkFile::array(const pugi::xml_node& element) {
    const std::string name = "array " + in_quotes(element.attribute("Name").value());
    const std::string_view format = element.attribute("format").value();
    const auto type = std::ranges::find(vtk_type_names, std::string_view(element.attribute("type").value()));
    VtkArray array;
    array.components = element.attribute("NumberOfComponents").as_int(1);
    if (type == vtk_type_names.end() || array.components < 1 || array.components > 1000)
        fail(name + " is of an unknown type", "the file may be damaged");
    array.type = static_cast<ScalarType>(type - vtk_type_names.begin());
    if (format == "ascii") {
        WordScanner words(element.child_value());
        for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
            const std::optional<double> number = value_of_type(word, array.type);
            if (!number) fail(name + ": " + in_quotes(word) + " is no number of its type", "the file may be damaged");
            array.values.push_back(*number);
        }
        return array;
    }
    std::string data;
    if (format == "appended") {
        const unsigned long long offset = element.attribute("offset").as_ullong(appended_.size());
        if (offset >= appended_.size()) fail(name + " has no data", "the file may be cut off");
        data = data_of(appended_.substr(offset), appended_is_text_, name);
    } else if (format == "binary") {
        data = data_of(without_leading_space(element.child_value()), true, name);
    } else {
        fail(name + " has the unknown format " + in_quotes(format), "formats are ascii, binary and appended");
    }
    const std::size_t size = size_of(array.type);
    if (data.size() % size != 0) fail(name + " ends within a number", "the file may be damaged");
    array.values.resize(data.size() / size);
    with_zero_of(array.type, [&](auto zero) {
        for (std::size_t i = 0; i < array.values.size(); ++i)
            array.values[i] = static_cast<double>(value_at<decltype(zero)>(data.data() + i * size, swapped_));
    });
    return array;
}

/// Returns the data behind their sizes, decoded and unpacked. Packed data have the number of blocks, their size, the size of the last (0:
/// like the others), and the packed size of each. In base64, sizes and data are encoded together or apart.
std::string VtkFile::data_of(std::string_view encoded, bool is_text, const std::string& name) {
    const std::size_t word = size_of(header_);
    const auto bytes = [&](std::size_t count) {   // the first so many
        std::string found = is_text ? from_base64_parts(encoded, count) : std::string(encoded.substr(0, count));
        if (found.size() < count) fail(name + " ends early", "the file may be cut off");
        return found;
    };
    const auto require = [&](bool fits) {
        if (!fits) fail(name + " claims more data than such a file can hold", "the file may be damaged");
    };
    const auto number = [&](const std::string& from, std::size_t i) {
        const std::uint64_t value = header_ == ScalarType::uint64 ? value_at<std::uint64_t>(from.data() + i * word, swapped_)
                                                                  : value_at<std::uint32_t>(from.data() + i * word, swapped_);
        require(value <= left_);
        return static_cast<std::size_t>(value);
    };
    const std::size_t count = number(bytes(word), 0);   // of bytes, or of blocks
    if (count == 0) return "";
    if (!is_packed_) {
        left_ -= count;
        return bytes(word + count).substr(word);
    }
    const std::size_t header_size = (3 + count) * word;
    const std::string header = bytes(header_size);
    const std::size_t block = number(header, 1), last = number(header, 2) == 0 ? block : number(header, 2);
    require(block == 0 || (left_ - last) / block >= count - 1);
    const std::size_t total = (count - 1) * block + last;
    require(left_ - total >= header_size);   // many arrays may share one
    left_ -= total + header_size;
    std::size_t packed_size = 0;
    for (std::size_t b = 0; b < count; ++b) {
        packed_size += number(header, 3 + b);
        require(packed_size <= encoded.size());
    }
    const std::string packed = bytes(header_size + packed_size);
    const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> unpacker(libdeflate_alloc_decompressor(),
                                                                                                     &libdeflate_free_decompressor);
    std::string data(total, '\0');
    for (std::size_t b = 0, at = header_size; b < count; at += number(header, 3 + b), ++b) {
        const libdeflate_result result = libdeflate_zlib_decompress(unpacker.get(), packed.data() + at, number(header, 3 + b),
                                                                    data.data() + b * block, b + 1 < count ? block : last, nullptr);
        if (result != LIBDEFLATE_SUCCESS) fail(name + ": damaged zlib data", "the file may be damaged");
    }
    return data;
}

}   // namespace meshfolio
