#include <algorithm>

#include "questions/core/chapter.h"

// The chapters in their order: the name of the folder, which is that of the namespace. A new one is a line here.
// clang-format off
#define MESHFOLIO_CHAPTERS(chapter) \
    chapter(q1_uniform) \
    chapter(q2_ellipsoid) \
    chapter(q3_cotangent) \
    chapter(q4_spectral) \
    chapter(q5_explicit) \
    chapter(q6_implicit) \
    chapter(q7_denoising) \
    chapter(truth) \
    chapter(stability) \
    chapter(modes) \
    chapter(methods) \
    chapter(operators) \
    chapter(certificates)
// clang-format on

namespace meshfolio {

#define MESHFOLIO_DECLARED(folder) \
    namespace folder {             \
    extern const Chapter chapter;  \
    }
MESHFOLIO_CHAPTERS(MESHFOLIO_DECLARED)

std::span<const Chapter* const> chapter_list() {
#define MESHFOLIO_LISTED(folder) &folder::chapter,
    static constexpr const Chapter* chapters[] = {MESHFOLIO_CHAPTERS(MESHFOLIO_LISTED)};
    return chapters;
}

std::vector<report::CodeReference> Chapter::cited_code() const {
    std::vector<report::CodeReference> cited;
    for (const Code& each : code) cited.push_back({each.function, each.file, words().line("code." + each.function)});
    return cited;
}

double ChapterCost::work_of(const QuestionSettings& settings, bool small) const {
    double work = 1;
    if (lengths == nullptr) return work;
    const auto count = [](const auto& list) { return static_cast<double>(std::max<std::size_t>(list.size(), 1)); };
    if (const std::vector<int>& asked = settings.*lengths; !asked.empty()) work *= std::ranges::max(asked) / length[small];
    if (!settings.lambda.empty() || !settings.noise.empty()) work *= count(settings.lambda) * count(settings.noise) / runs[small];
    return work;
}

const Chapter& chapter_of_id(std::string_view id) {
    const auto found = std::ranges::find(chapter_list(), id, &Chapter::id);
    if (found == chapter_list().end()) throw std::logic_error("no chapter has the id '" + std::string(id) + "'");
    return **found;
}

std::vector<std::string> section_ids() {
    std::vector<std::string> ids;
    for (const Chapter* chapter : chapter_list()) ids.emplace_back(chapter->id);
    return ids;
}

}   // namespace meshfolio
