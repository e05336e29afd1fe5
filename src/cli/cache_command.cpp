#include <memory>

#include "base/number_text.h"
#include "cli/commands.h"
#include "run/console.h"
#include "run/section_cache.h"

namespace meshfolio::cli {

Command cache_command(CLI::App& parent) {
    const auto action = std::make_shared<std::string>("show");
    CommandOptions app(parent, "cache", "Folder and size of the cache, which keeps answers of earlier reports");
    app.choice("ACTION", *action, {"show", "clear"}, "show, or clear: remove them all");
    app.footer(
        "The cache is $XDG_CACHE_HOME/meshfolio, of at most MESHFOLIO_CACHE_LIMIT megabytes (2048); the least recently used answers go "
        "first.\n"
        "Example: meshfolio cache clear");
    return {app, [action] {
                const auto store = usable_cache();
                if (!store) return ExitCode::ok;
                if (*action == "clear") {
                    store->clear();
                    return ExitCode::ok;
                }
                const output::ResultCache::Size size = store->size();
                print_path(store->folder());
                print(std::to_string(size.files) + " files, " + plain_text(static_cast<double>(size.bytes) / 1e6, 4) + " MB\n");
                return ExitCode::ok;
            }};
}

}   // namespace meshfolio::cli
