/// @file
/// The JSON and the data of a file of binary glTF 2.0 (Khronos, "glTF 2.0 Specification", 2021; sections are cited as §).
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "mesh/io/polygon_list.h"
#include "mesh/io/scalar_type.h"

namespace meshfolio {

/// Elements of numbers (§3.6.2), perhaps with some of them replaced (§3.6.2.3, sparse accessors). Zeros where there is no data.
struct GlbAccessor {
    const char* data = nullptr;   // null: zeros
    std::size_t count = 0, stride = 0;
    ScalarType type = ScalarType::float32;
    int components = 1;
    bool normalized = false;

    std::size_t replaced = 0;   // elements; their numbers rise
    ScalarType index_type = ScalarType::uint32;
    const char *indices = nullptr, *replacements = nullptr;

    std::size_t element_size() const { return size_of(type) * static_cast<std::size_t>(components); }
    std::size_t replaced_index(std::size_t slot) const;
    /// Component k of element i < count; normalised integers as §3.11 converts them.
    double operator()(std::size_t i, int k) const;
};

class GlbDocument {
public:
    using Json = nlohmann::json;

    /// @throws InputError unless the bytes are chunks of JSON and data that use no required extension beyond what is read
    GlbDocument(std::string_view bytes, const std::string& file, WarningTally& warnings);

    const Json& json() const { return json_; }
    /// Entry `index` of a list at the top, and how many entries the list has.
    const Json& entry(const char* list, std::size_t index) const;
    std::size_t size_of_list(const char* list) const;
    /// A whole number of an object, from 0; `otherwise` where it is not there.
    std::size_t number(const Json& object, const char* key, std::size_t otherwise) const;
    GlbAccessor accessor(std::size_t index);
    /// The accessor of an attribute, which must be there.
    GlbAccessor accessor(const Json& attributes, const std::string& name);

    /// Refuses more points or triangles than `most`: a million, or as many as the file has bytes, because instances may multiply what a
    /// small file holds.
    void refuse_too_many(std::size_t count) const;
    std::size_t most() const { return most_; }
    /// Counts what is read again for each instance, and refuses more than 32 times `most`.
    void spend(std::size_t steps);

    [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const { throw InputError({file_, 0}, problem, remedy); }
    [[noreturn]] void damaged(const std::string& problem) const { fail(problem, "the file may be damaged"); }

private:
    std::string_view take_chunk(std::string_view& bytes, std::string_view type) const;
    void refuse_unknown(const std::string& extension) const;
    const char* bytes_of_view(const Json& view, std::size_t offset, std::size_t size, const std::string& name) const;
    void add_replacements(GlbAccessor& accessor, const Json& sparse, const std::string& name);

    std::string file_;
    std::size_t most_ = 0, spent_ = 0;
    Json json_;
    std::string_view data_;
};

}   // namespace meshfolio
