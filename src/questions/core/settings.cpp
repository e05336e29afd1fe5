#include "questions/core/settings.h"

#include <stdexcept>

#include "embedded_data.h"

namespace meshfolio {

std::string_view default_settings_text() {
    for (const auto& file : meshfolio_embedded::embedded_data()) {
        if (file.name == "report.toml") return file.bytes;
    }
    throw std::logic_error("the default settings are not compiled in");
}

}   // namespace meshfolio
