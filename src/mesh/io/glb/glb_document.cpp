#include "mesh/io/glb/glb_document.h"

#include <map>

#include "base/at.h"
#include "base/in_quotes.h"

namespace meshfolio {

static std::uint32_t word(std::string_view bytes, std::size_t offset) { return little_endian<std::uint32_t>(bytes.data() + offset); }

std::size_t GlbAccessor::replaced_index(std::size_t slot) const {
    return with_zero_of(index_type,
                        [&](auto zero) { return static_cast<std::size_t>(little_endian<decltype(zero)>(indices + slot * sizeof(zero))); });
}

double GlbAccessor::operator()(std::size_t i, int k) const {
    const char* element = data == nullptr ? nullptr : data + i * stride;
    std::size_t low = 0;
    for (std::size_t high = replaced; low < high;) {
        const std::size_t middle = (low + high) / 2;
        if (replaced_index(middle) < i) low = middle + 1;
        else high = middle;
    }
    if (low < replaced && replaced_index(low) == i) element = replacements + low * element_size();
    if (element == nullptr) return 0;
    return with_zero_of(type, [&](auto zero) {
        using T = decltype(zero);
        const auto value = static_cast<double>(little_endian<T>(element + at(k) * sizeof(T)));
        return normalized ? std::max(value / static_cast<double>(std::numeric_limits<T>::max()), -1.0) : value;
    });
}

GlbDocument::GlbDocument(std::string_view bytes, const std::string& file, WarningTally& warnings) : file_(file) {
    if (bytes.size() < 20 || !bytes.starts_with("glTF")) fail("no header of binary glTF", "the file may be cut off");
    const auto version = word(bytes, 4);
    if (version != 2) fail("glTF version " + std::to_string(version) + " is not supported", "export it as glTF 2.0");
    const std::size_t size = word(bytes, 8);
    if (size > bytes.size() || size < 20) fail("ends early (byte " + std::to_string(bytes.size()) + ")", "the file may be cut off");
    if (size < bytes.size()) warnings.add(0, "bytes after the end ignored", "bytes after the end ignored");
    most_ = std::clamp<std::size_t>(size / 4, 200000, most_triangles);
    bytes = bytes.substr(12, size - 12);
    const std::string_view text = take_chunk(bytes, "JSON");
    if (!bytes.empty()) data_ = take_chunk(bytes, {"BIN\0", 4});
    json_ = Json::parse(text);
    for (const Json& extension : json_.value("extensionsRequired", Json::array())) refuse_unknown(extension.get<std::string>());
}

std::string_view GlbDocument::take_chunk(std::string_view& bytes, std::string_view type) const {
    if (bytes.size() < 8 || word(bytes, 0) > bytes.size() - 8) fail("ends early within a chunk", "the file may be cut off");
    if (bytes.substr(4, 4) != type) damaged("the chunks are not JSON and BIN");
    const std::string_view chunk = bytes.substr(8, word(bytes, 0));
    bytes.remove_prefix(8 + chunk.size());
    return chunk;
}

/// Checks a required extension. @throws InputError unless it is supported or changes the look only
void GlbDocument::refuse_unknown(const std::string& extension) const {
    static constexpr std::array harmless{
        "KHR_mesh_quantization", "EXT_mesh_gpu_instancing", "KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_"};
    if (std::ranges::none_of(harmless, [&](const char* begin) { return extension.starts_with(begin); }))
        fail("needs the extension " + in_quotes(extension), "export it without compression or extensions");
}

std::size_t GlbDocument::number(const Json& object, const char* key, std::size_t otherwise) const {
    const auto found = object.find(key);
    if (found == object.end()) return otherwise;
    if (!found->is_number_unsigned() || found->get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max())
        damaged(std::string(key) + " is no whole number");
    return found->get<std::size_t>();
}

std::size_t GlbDocument::size_of_list(const char* list) const {
    const auto found = json_.find(list);
    return found != json_.end() && found->is_array() ? found->size() : 0;
}

const GlbDocument::Json& GlbDocument::entry(const char* list, std::size_t index) const {
    if (index >= size_of_list(list)) damaged("no entry " + std::to_string(index) + " of " + list);
    return json_.at(list)[index];
}

/// Returns `size` bytes from `offset` in the view (§3.6.1).
const char* GlbDocument::bytes_of_view(const Json& view, std::size_t offset, std::size_t size, const std::string& name) const {
    if (view.contains("extensions") && view["extensions"].contains("EXT_meshopt_compression")) refuse_unknown("EXT_meshopt_compression");
    const std::size_t buffer = number(view, "buffer", 0);
    if (buffer > 0 || entry("buffers", buffer).contains("uri"))
        fail(name + " is in another file or in text", "export it as GLB with all data embedded");
    const std::size_t begin = number(view, "byteOffset", 0), length = number(view, "byteLength", 0);
    if (begin + length > data_.size() || offset + size > length) fail(name + " reaches beyond its data", "the file may be cut off");
    return data_.data() + begin + offset;
}

/// Reads replaced elements. Their indices are unsigned integers that rise strictly (§5.3, §5.4).
void GlbDocument::add_replacements(GlbAccessor& made, const Json& sparse, const std::string& name) {
    static const std::map<std::size_t, ScalarType> types{{5121, ScalarType::uint8}, {5123, ScalarType::uint16}, {5125, ScalarType::uint32}};
    const Json &indices = sparse.at("indices"), &values = sparse.at("values");
    made.replaced = number(sparse, "count", 0);
    const auto type = types.find(number(indices, "componentType", 0));
    if (type == types.end() || made.replaced == 0 || made.replaced > made.count) damaged(name + " has sparse entries that cannot be");
    made.index_type = type->second;
    made.indices = bytes_of_view(entry("bufferViews", number(indices, "bufferView", 0)), number(indices, "byteOffset", 0),
                                 made.replaced * size_of(made.index_type), name);
    made.replacements = bytes_of_view(entry("bufferViews", number(values, "bufferView", 0)), number(values, "byteOffset", 0),
                                      made.replaced * made.element_size(), name);
    spend(made.replaced);
    for (std::size_t slot = 0; slot < made.replaced; ++slot)
        if (made.replaced_index(slot) >= made.count || (slot > 0 && made.replaced_index(slot) <= made.replaced_index(slot - 1)))
            damaged(name + " has sparse indices that do not rise or are out of range");
}

GlbAccessor GlbDocument::accessor(std::size_t index) {
    spend(32);   // takes as long as reading 32 numbers
    const Json& json = entry("accessors", index);
    const std::string name = "accessor " + std::to_string(index);
    static const std::map<std::size_t, ScalarType> types{{5120, ScalarType::int8},   {5121, ScalarType::uint8},
                                                         {5122, ScalarType::int16},  {5123, ScalarType::uint16},
                                                         {5125, ScalarType::uint32}, {5126, ScalarType::float32}};
    static const std::map<std::string, int> shapes{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    const auto type = types.find(number(json, "componentType", 0));
    const auto shape = shapes.find(json.value("type", ""));
    if (type == types.end() || shape == shapes.end()) damaged(name + " is of a type that is not supported");
    GlbAccessor made;
    made.count = number(json, "count", 0);
    made.type = type->second;
    made.components = shape->second;
    made.normalized = json.value("normalized", false) && is_integer(made.type);
    if (made.count == 0) damaged(name + " is empty");
    if (json.contains("bufferView")) {
        const Json& view = entry("bufferViews", number(json, "bufferView", 0));
        made.stride = number(view, "byteStride", made.element_size());
        if (made.stride < made.element_size() || made.stride > 255) damaged(name + " has rows that cannot be");
        made.data = bytes_of_view(view, number(json, "byteOffset", 0), (made.count - 1) * made.stride + made.element_size(), name);
    }
    if (json.contains("sparse")) add_replacements(made, json["sparse"], name);
    return made;
}

GlbAccessor GlbDocument::accessor(const Json& attributes, const std::string& name) {
    if (!attributes.contains(name)) damaged("a primitive has no attribute " + name);
    return accessor(number(attributes, name.c_str(), 0));
}

void GlbDocument::refuse_too_many(std::size_t count) const {
    if (count > most_)
        fail("its instances make more than " + std::to_string(most_) + " vertices, values or triangles", "export one of each mesh");
}

void GlbDocument::spend(std::size_t steps) {
    spent_ += steps;
    if (spent_ / 32 > most_) refuse_too_many(spent_);
}

}   // namespace meshfolio
