#include "run/provenance.h"

#include <Spectra/Util/Version.h>
#include <sys/stat.h>
#include <tbb/version.h>
#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <fstream>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "base/errors.h"
#include "base/linux_only.h"
#include "base/sha256.h"
#include "build_info.h"
#include "output/cache/result_cache.h"
#include "questions/core/chapter.h"
#include "report/words.h"
#include "run/arguments.h"
#include "run/settings/report_settings.h"
#include "submission/source_listing.h"

namespace meshfolio::run {

namespace {

/// Returns the chapters of every report: questions by their numbers, supporting sections by their letters.
std::vector<submission::CitingSection> index_of_sections() {
    std::vector<submission::CitingSection> index;
    char letter = 'A';
    for (const Chapter* chapter : chapter_list()) {
        std::string label = chapter->is_question() ? "Q" + std::string(chapter->id.substr(1)) : std::string(1, letter++);
        index.push_back({std::move(label), chapter->title(), chapter->cited_code()});
    }
    return index;
}

void add_library(output::KeyMaker& key, const std::string& name) {
    struct stat status {};
    if (::stat(name.c_str(), &status) != 0) return;   // the program itself, the kernel's page
    key.add(name)
        .add(std::to_string(status.st_size))
        .add(std::to_string(status.st_mtim.tv_sec) + "." + std::to_string(status.st_mtim.tv_nsec));
}

/// Adds the first line of each kind in /proc/cpuinfo that identifies the processor.
void add_processor(output::KeyMaker& key) {
    std::ifstream file("/proc/cpuinfo");
    std::set<std::string> seen;
    for (std::string line; std::getline(file, line);) {
        const std::string name = line.substr(0, line.find('\t'));
        const bool tells = name == "vendor_id" || name == "cpu family" || name == "model" || name == "model name" || name == "flags" ||
                           name == "CPU part" || name == "Features";
        if (tells && seen.insert(name).second) key.add(line);
    }
}

std::string identity_now() try {
    output::KeyMaker key;
    key.add(sha256_of_file(this_program()));
    for (const std::string& name : loaded_libraries()) add_library(key, name);
    add_processor(key);
    for (const char* name : {"GLIBC_TUNABLES", "LD_PRELOAD"}) key.add(environment(name));
    return key.key();
} catch (const InputError&) {
    return "";
}

std::string dotted(int major, int minor, int patch) {
    return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

std::map<std::string, std::string> words_of(const report::Provenance& provenance) {
    std::map<std::string, std::string> words = provenance.settings;
    words.erase("only");
    for (const auto& [library, version] : provenance.libraries) words["library " + library] = version;
    words["version"] = provenance.version;
    words["commit"] = provenance.commit;
    words["compiler"] = provenance.compiler + ", " + provenance.build_type;
    words["seed"] = std::to_string(provenance.seed);
    return words;
}

}   // namespace

const submission::SourceListing& own_source() {
    static const submission::SourceListing listing("meshfolio " + std::string(build_info::version) + ": all source of its own",
                                                   submission::source_tree(), index_of_sections());
    return listing;
}

const std::string& program_identity() {
    static const std::string identity = identity_now();
    return identity;
}

std::string difference(const report::Provenance& one, const report::Provenance& other) {
    std::map<std::string, std::string> a = words_of(one), b = words_of(other);
    for (const auto& [key, value] : words_of(one)) b.try_emplace(key, "none");
    for (const auto& [key, value] : b) {
        const std::string& own = a.try_emplace(key, "none").first->second;
        if (own != value) return key + " " + own + ", and not " + value;
    }
    return "";
}

report::Provenance provenance_of(std::map<std::string, std::string> settings, std::uint64_t seed) {
    if (const std::string words = report::words_identity(); !words.empty()) settings["words"] = sha256(words).substr(0, 12);
    return {.version = build_info::version,
            .commit = build_info::commit,
            .compiler = build_info::compiler,
            .build_type = build_info::build_type,
            .libraries = {{"Spectra", dotted(SPECTRA_MAJOR_VERSION, SPECTRA_MINOR_VERSION, SPECTRA_PATCH_VERSION)},
                          {"Eigen", dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
                          {"GLM", dotted(GLM_VERSION_MAJOR, GLM_VERSION_MINOR, GLM_VERSION_PATCH)},
                          {"nlohmann-json", dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
                          {"oneTBB", dotted(TBB_VERSION_MAJOR, TBB_VERSION_MINOR, TBB_VERSION_PATCH)},
                          {"CLI11", CLI11_VERSION}},
            .settings = std::move(settings),
            .seed = seed};
}

}   // namespace meshfolio::run
