#include "run/provenance.h"

#include <Spectra/Util/Version.h>
#include <tbb/version.h>
#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include "build_info.h"

namespace meshfolio::run {

namespace {

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
    report::Provenance provenance;
    provenance.version = build_info::version;
    provenance.commit = build_info::commit;
    provenance.compiler = build_info::compiler;
    provenance.build_type = build_info::build_type;
    provenance.libraries["Spectra"] = dotted(SPECTRA_MAJOR_VERSION, SPECTRA_MINOR_VERSION, SPECTRA_PATCH_VERSION);
    provenance.libraries["Eigen"] = dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
    provenance.libraries["GLM"] = dotted(GLM_VERSION_MAJOR, GLM_VERSION_MINOR, GLM_VERSION_PATCH);
    provenance.libraries["nlohmann-json"] = dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH);
    provenance.libraries["oneTBB"] = dotted(TBB_VERSION_MAJOR, TBB_VERSION_MINOR, TBB_VERSION_PATCH);
    provenance.libraries["CLI11"] = CLI11_VERSION;
    provenance.settings = std::move(settings);
    provenance.seed = seed;
    return provenance;
}

}   // namespace meshfolio::run
