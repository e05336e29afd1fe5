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

/// A list of elements of 1 to 16 numbers (§3.6.2), perhaps with replacements for some elements (§3.6.2.3, sparse accessors).
struct GlbAccessor {
    const char* data = nullptr;   // null: all zeros
    std::size_t count = 0, stride = 0;
    ScalarType type = ScalarType::float32;
    int components = 1;
    bool normalized = false;

    std::size_t replaced = 0;   // number of replaced elements; their indices rise
    ScalarType index_type = ScalarType::uint32;
    const char *indices = nullptr, *replacements = nullptr;

    std::size_t element_size() const { return size_of(type) * static_cast<std::size_t>(components); }
    /// Returns the index of the element that replacement number `slot` replaces.
    std::size_t replaced_index(std::size_t slot) const;
    /// Returns component k of element i < count; normalised integers are converted (§3.11).
    double operator()(std::size_t i, int k) const;
};

class GlbDocument {
public:
    using Json = nlohmann::json;

    /// @param bytes  the whole file @param file  its name in messages
    /// @throws InputError if the bytes are no chunks of JSON and data, or require an extension that is not supported
    GlbDocument(std::string_view bytes, const std::string& file, WarningTally& warnings);

    const Json& json() const { return json_; }
    /// Returns entry `index` of a list of the file, such as "meshes". @throws InputError if there is none
    const Json& entry(const char* list, std::size_t index) const;
    /// Returns the number of entries of a list of the file, such as "nodes"; 0 if there is no such list.
    std::size_t size_of_list(const char* list) const;
    /// Returns the whole number ≥ 0 that an object has under `key`; `otherwise` if it has none. @throws InputError for another value
    std::size_t number(const Json& object, const char* key, std::size_t otherwise) const;
    /// Returns accessor `index`, with its data. @throws InputError if they do not fit the file
    GlbAccessor accessor(std::size_t index);
    /// Returns the accessor of the attribute `name`, such as "POSITION". @throws InputError if there is none
    GlbAccessor accessor(const Json& attributes, const std::string& name);

    /// Checks a number of points or triangles. @throws InputError beyond 200,000 and a quarter of the file's bytes, whichever is larger:
    /// instances may multiply a small mesh
    void refuse_too_many(std::size_t count) const;
    /// Counts steps of reading, which instances repeat. @throws InputError if their sum exceeds 32 times the limit of refuse_too_many()
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
