#include "mesh/io/mesh_files.h"

#include <algorithm>
#include <cctype>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "mesh/io/text_scanner.h"

namespace meshfolio {

namespace {

struct Format {
    std::string_view ending;
    std::string_view name;
    LoadedMesh (*parse)(std::string_view bytes, const std::string& file);
};

constexpr Format formats[] = {
    {".obj", "OBJ", parse_obj},
    {".off", "OFF", parse_off},
    {".ply", "PLY", parse_ply},
    {".stl", "STL", parse_stl},
};

/// First bytes of what is sometimes saved under a mesh's name.
struct Signature {
    std::string_view begin;
    std::string_view what;
    std::string_view remedy;
};

using namespace std::string_view_literals;

constexpr Signature signatures[] = {
    {"PK\x03\x04"sv, "ZIP archive, not a mesh"sv, "unpack it first"sv},
    {"\x1f\x8b"sv, "gzip data, not a mesh"sv, "unpack it with gunzip first"sv},
    {"BZh"sv, "bzip2 data, not a mesh"sv, "unpack it first"sv},
    {"\xfd"
     "7zXZ"sv,
     "xz data, not a mesh"sv, "unpack it first"sv},
    {"7z\xbc\xaf"sv, "7-Zip archive, not a mesh"sv, "unpack it first"sv},
    {"\x28\xb5\x2f\xfd"sv, "zstd data, not a mesh"sv, "unpack it first"sv},
    {"version https://git-lfs"sv, "Git LFS pointer, not the mesh itself"sv, "run 'git lfs pull'"sv},
    {"\xff\xfe"sv, "UTF-16 text"sv, "save it as UTF-8 or ASCII"sv},
    {"\xfe\xff"sv, "UTF-16 text"sv, "save it as UTF-8 or ASCII"sv},
    {"%PDF"sv, "PDF document, not a mesh"sv, "name the mesh file"sv},
    {"\x89PNG"sv, "PNG picture, not a mesh"sv, "name the mesh file"sv},
    {"glTF"sv, "binary glTF, which is not supported"sv, "convert it to OBJ, OFF, PLY or STL"sv},
    {"Kaydara FBX"sv, "FBX, which is not supported"sv, "convert it to OBJ, OFF, PLY or STL"sv},
};

std::string lower_case(std::string_view text) {
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return lower;
}

void refuse_other_content(std::string_view bytes, const std::string& file) {
    for (const Signature& s : signatures) {
        if (bytes.starts_with(s.begin)) throw InputError({file, 0}, std::string(s.what), std::string(s.remedy));
    }
    std::string_view start = without_bom(bytes).substr(0, 256);
    start.remove_prefix(std::min(start.find_first_not_of(" \t\r\n"), start.size()));
    const std::string text = lower_case(start.substr(0, 16));
    for (const char* tag : {"<!doctype", "<html", "<head", "<body"}) {
        if (text.starts_with(tag))
            throw InputError({file, 0}, "HTML page, not a mesh", "the download may have failed; fetch the file itself");
    }
    if (text.starts_with("<")) throw InputError({file, 0}, "XML text, not a mesh", "convert it to OBJ, OFF, PLY or STL");
}

/// The format that the first word of a text belongs to, by its ending; empty where it could be anything.
std::string_view ending_of_content(std::string_view bytes) {
    const std::string_view start = without_bom(bytes).substr(0, 4096);
    LineScanner lines(start);
    const bool binary = start.find('\0') != std::string_view::npos && !start.starts_with("ply");
    if (binary || !lines.next_with_words()) return {};
    std::string_view line = lines.line();
    const std::string_view word = take_word(line);
    const bool off_keyword = word.ends_with("OFF") && word.find_first_not_of("STCN4nOF") == std::string_view::npos;
    if (off_keyword) return ".off";
    if (word == "ply") return ".ply";
    for (const char* keyword : {"v", "vn", "vt", "mtllib", "usemtl", "o", "g"}) {
        if (word == keyword) return ".obj";
    }
    return word == "solid" ? ".stl" : "";
}

}   // namespace

std::string lower_case_ending(const std::string& file) { return lower_case(std::filesystem::path(file).extension().string()); }

bool is_mesh_file(const std::string& file) {
    return std::ranges::find(formats, std::string_view(lower_case_ending(file)), &Format::ending) != std::end(formats);
}

LoadedMesh parse_mesh(std::string_view bytes, const std::string& file) {
    const std::string ending = lower_case_ending(file);
    const auto format = std::find_if(std::begin(formats), std::end(formats), [&](const Format& f) { return f.ending == ending; });
    if (format == std::end(formats)) {
        throw InputError({file, 0}, "unknown mesh format '" + ending + "'", "meshes end in .obj, .off, .ply or .stl");
    }
    if (bytes.empty()) throw InputError({file, 0}, "file is empty", "export or download the mesh again");
    refuse_other_content(bytes, file);
    const std::string_view content = ending_of_content(bytes);
    const auto other = std::find_if(std::begin(formats), std::end(formats), [&](const Format& f) { return f.ending == content; });
    if (other != std::end(formats) && other != format) {
        throw InputError({file, 0}, "looks like " + std::string(other->name) + ", but the name says " + ending,
                         "rename it to end in " + std::string(content));
    }
    return format->parse(bytes, file);
}

LoadedMesh read_mesh(const std::filesystem::path& path) { return parse_mesh(read_file(path), path.string()); }

}   // namespace meshfolio
