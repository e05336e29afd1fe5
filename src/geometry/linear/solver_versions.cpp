#include "geometry/linear/solver_versions.h"

#include <Spectra/Util/Version.h>

#ifdef MESHFOLIO_WITH_CHOLMOD
#include <cholmod.h>
#endif

namespace meshfolio {

std::map<std::string, std::string> solver_versions() {
    std::map<std::string, std::string> versions;
    const auto dotted = [](int major, int minor, int patch) {
        return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
    };
    versions["Spectra"] = dotted(SPECTRA_MAJOR_VERSION, SPECTRA_MINOR_VERSION, SPECTRA_PATCH_VERSION);
#ifdef MESHFOLIO_WITH_CHOLMOD
    versions["CHOLMOD"] = dotted(CHOLMOD_MAIN_VERSION, CHOLMOD_SUB_VERSION, CHOLMOD_SUBSUB_VERSION);
#endif
    return versions;
}

}   // namespace meshfolio
