#include "cli/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "cli/console.h"
#include "errors.h"

namespace meshfolio::cli {

namespace {

constexpr int bar_cells = 20;

int terminal_width() {
    winsize size{};
    return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

/// At most `columns` code points of UTF-8.
std::string cut(const std::string& text, int columns) {
    std::size_t end = 0;
    for (int taken = 0; end < text.size(); ++end) {
        const bool begins = (static_cast<unsigned char>(text[end]) & 0xc0u) != 0x80u;
        if (begins && taken++ == columns) break;
    }
    return text.substr(0, end);
}

void to_stderr(const std::string& text) {
    if (::write(STDERR_FILENO, text.data(), text.size()) < 0) {
        // Progress is no reason to fail.
    }
}

}   // namespace

std::string progress_line(double fraction, std::string_view step, int width) {
    const double done = std::clamp(fraction, 0.0, 1.0);
    const int full = static_cast<int>(std::floor(done * bar_cells));
    std::string line = "[";
    for (int i = 0; i < bar_cells; ++i) line += i < full ? "#" : "·";
    const std::string percent = std::to_string(static_cast<int>(std::floor(100 * done)));
    line += "] " + std::string(3 - std::min<std::size_t>(3, percent.size()), ' ') + percent + " %  " + printable(std::string(step));
    return cut(line, width);
}

bool stderr_is_terminal() {
    const char* kind = std::getenv("TERM");
    return ::isatty(STDERR_FILENO) == 1 && kind != nullptr && std::string_view(kind) != "dumb";
}

ProgressDisplay::ProgressDisplay(bool terminal) : terminal_(terminal) {}

ProgressDisplay::~ProgressDisplay() {
    if (drawn_) to_stderr("\r\x1b[K");
}

void ProgressDisplay::advance(double fraction) {
    const std::lock_guard lock(mutex_);
    fraction_ = fraction;
    if (terminal_) draw(fraction >= 1);
}

void ProgressDisplay::step(std::string_view what) {
    const std::lock_guard lock(mutex_);
    step_ = what;
    if (terminal_) draw(false);
}

void ProgressDisplay::milestone(std::string_view what) {
    const std::lock_guard lock(mutex_);
    step_ = what;
    if (terminal_) {
        draw(false);
    } else {
        complain(step_);
    }
}

void ProgressDisplay::draw(bool now) {
    constexpr auto interval = std::chrono::milliseconds(100);
    const Clock::time_point time = Clock::now();
    if (drawn_ && !now && time - drawn_at_ < interval) return;
    drawn_at_ = time;
    drawn_ = true;
    to_stderr("\r" + progress_line(fraction_, step_, terminal_width() - 1) + "\x1b[K");
}

}   // namespace meshfolio::cli
