#include "questions/core/settings.h"

#include <algorithm>

#include "embedded_data.h"
#include "embedded_reports.h"

namespace meshfolio {

std::string_view bundled_report_text(const std::string& name) {
    for (const auto& file : meshfolio_embedded::embedded_reports())
        if (file.name == name + ".toml") return file.bytes;
    return {};
}

std::vector<std::string> bundled_report_names() {
    std::vector<std::string> names;
    for (const auto& file : meshfolio_embedded::embedded_reports()) names.emplace_back(file.name.substr(0, file.name.rfind('.')));
    std::ranges::sort(names);
    return names;
}

std::string_view default_settings_text() {
    for (const auto& file : meshfolio_embedded::embedded_data())
        if (file.name == "report.toml") return file.bytes;
    throw std::logic_error("data/report.toml, the default settings, is not compiled in");
}

}   // namespace meshfolio
