// Settings as words: for the provenance, and for the keys of the cache.
#include <type_traits>

#include "base/joined.h"
#include "base/number_text.h"
#include "run/settings/report_settings.h"
#include "run/settings/setting_list.h"

namespace meshfolio::run {

namespace {

using Words = std::vector<std::string>;

Words words_of(bool value) { return {value ? "yes" : "no"}; }
Words words_of(const std::string& value) { return {value}; }
Words words_of(const std::filesystem::path& value) { return {value.string()}; }
Words words_of(const ViewSize& size) { return {std::to_string(size.width) + " × " + std::to_string(size.height)}; }
Words words_of(render::Up up) { return {axis_names()[static_cast<std::size_t>(up)]}; }
Words words_of(const render::Angles& camera) { return {exact_text(camera.azimuth), exact_text(camera.elevation), exact_text(camera.roll)}; }
Words words_of(const PageTemplate& page) { return {page.design, page.file.value_or("").string()}; }
Words words_of(const Effort& effort) {
    if (effort.left_out) return {"left out"};
    const std::string copies = effort.most_vertices > 0 ? ", copies of at most " + std::to_string(effort.most_vertices) + " vertices" : "";
    return {(effort.small ? "small settings" : "full settings") + copies};
}
template <class Number>
requires std::is_arithmetic_v<Number> Words words_of(Number value) {
    if constexpr (std::is_integral_v<Number>) return {std::to_string(value)};
    else return {exact_text(value)};
}
template <class Value> Words words_of(const std::optional<Value>& value) { return value ? words_of(*value) : Words(); }
template <class Value> Words words_of(const std::vector<Value>& values) {
    Words words;
    for (const Value& value : values) words.push_back(words_of(value).front());
    return words;
}

}   // namespace

std::map<std::string, std::string> described(const ReportSettings& settings) {
    std::map<std::string, std::string> values;
    const auto enter_as = [&values](const std::string& prefix) {
        return [&values, prefix](const Setting& setting, const auto& value) {
            Words words = words_of(value);
            if constexpr (std::is_same_v<decltype(value), const std::vector<std::filesystem::path>&>)   // without their folders
                for (std::string& word : words) word = std::filesystem::path(word).filename().string();
            const std::string text = joined(words, ", ");
            if (*setting.name != '\0' && text != setting.unsaid) values[prefix + setting.name] = text;
        };
    };
    for_each_setting(settings, enter_as(""));
    for (const auto& [id, table] : settings.questions) for_each_setting(table, enter_as(id + " "));
    for (const auto& [id, effort] : settings.efforts)
        if (words_of(effort) != words_of(Effort{.small = settings.quick})) values[id + effort_suffix] = words_of(effort).front();
    return values;
}

std::vector<std::string> identity_of(const ReportSettings& settings, const std::string& question) {
    Words identity;
    const auto add = [&](const Setting& setting, const auto& value) {
        if (!setting.shapes_answers) return;
        const Words words = words_of(value);
        identity.push_back(std::to_string(words.size()));
        identity.insert(identity.end(), words.begin(), words.end());
    };
    for_each_setting(settings, add);
    identity.push_back(words_of(effort_of(settings, question)).front());
    for_each_setting(table_of(settings, question), add);
    return identity;
}

}   // namespace meshfolio::run
