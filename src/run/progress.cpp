#include "run/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <cstdlib>
#include <thread>
#include <vector>

#include "base/errors.h"
#include "base/number_text.h"
#include "base/terminal.h"
#include "run/console.h"

namespace meshfolio::run {

namespace {

constexpr int bar_cells = 20;

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
    return shortened(line, width);
}

std::string stage_line(std::string_view what, double fraction, int seconds, int width) {
    const std::string share =
        fraction >= 0 ? ", " + std::to_string(static_cast<int>(std::floor(100 * std::min(fraction, 1.0)))) + " %" : "";
    const std::string tail = share + ", " + std::to_string(seconds) + " s";
    return shortened(shortened(printable(std::string(what)), width - static_cast<int>(tail.size())) + tail, width);
}

namespace {

/// The stages of the process and the thread that shows them.
class StageBoard {
public:
    static StageBoard& instance() {
        static StageBoard board;
        return board;
    }

    std::size_t push(const std::string& what) {
        const std::lock_guard lock(mutex_);
        stages_.push_back({stages_.empty() ? what : stages_.back().what + ": " + what, -1});
        if (stages_.size() == 1) begin();
        return stages_.size() - 1;
    }
    void pop() {
        const std::lock_guard lock(mutex_);
        wipe();
        stages_.pop_back();
    }
    void advance(std::size_t depth, double fraction) {
        const std::lock_guard lock(mutex_);
        if (depth < stages_.size()) stages_[depth].fraction = fraction;
    }
    void make_room() {
        const std::lock_guard lock(mutex_);
        wipe();
    }
    void count_displays(int change) {
        const std::lock_guard lock(mutex_);
        wipe();
        displays_ += change;
    }

private:
    struct Shown {
        std::string what;
        double fraction;
    };

    void begin() {
        begun_ = std::chrono::steady_clock::now();
        if (ticker_.joinable() || !stderr_is_terminal()) return;
        ticker_ = std::jthread([this](const std::stop_token& stop) { tick(stop); });
    }
    void tick(const std::stop_token& stop) {
        std::unique_lock lock(mutex_);
        while (!stop.stop_requested()) {
            waiting_.wait_for(lock, stop, std::chrono::seconds(1), [] { return false; });
            const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - begun_).count();
            if (stop.stop_requested() || stages_.empty() || displays_ > 0 || seconds < 2) continue;
            const Shown& top = stages_.back();
            to_stderr("\r" + stage_line(top.what, top.fraction, static_cast<int>(seconds), terminal_width(STDERR_FILENO) - 1) + "\x1b[K");
            drawn_ = true;
        }
    }
    void wipe() {
        if (drawn_) to_stderr("\r\x1b[K");
        drawn_ = false;
    }

    std::mutex mutex_;
    std::condition_variable_any waiting_;
    std::vector<Shown> stages_;
    std::chrono::steady_clock::time_point begun_;
    int displays_ = 0;
    bool drawn_ = false;
    std::jthread ticker_;   // the last member: it ends before the others do
};

}   // namespace

Stage::Stage(const std::string& what) : depth_(StageBoard::instance().push(what)) {}
Stage::~Stage() { StageBoard::instance().pop(); }
void Stage::advance(double fraction) { StageBoard::instance().advance(depth_, fraction); }

void make_room_on_terminal() { StageBoard::instance().make_room(); }

bool stderr_is_terminal() {
    const char* kind = std::getenv("TERM");
    return ::isatty(STDERR_FILENO) == 1 && kind != nullptr && std::string_view(kind) != "dumb";
}

double seconds_left(double expected, double taken, double fraction) {
    if (expected <= 0) return fraction > 0 ? (1 - fraction) * taken / fraction : 0;
    return (1 - fraction) * ((1 - fraction) * expected + taken);
}

std::string time_text(double seconds) {
    if (seconds < 100) return plain_text(std::ceil(seconds)) + " s";
    return seconds < 6000 ? plain_text(std::ceil(seconds / 60)) + " min" : plain_text(rounded(seconds / 3600, 2)) + " h";
}

ProgressDisplay::ProgressDisplay(bool terminal, double expected) : terminal_(terminal), expected_(expected) {
    StageBoard::instance().count_displays(1);
}

ProgressDisplay::~ProgressDisplay() {
    StageBoard::instance().count_displays(-1);
    if (drawn_) to_stderr("\r\x1b[K");
}

std::string ProgressDisplay::left() const {
    const std::lock_guard lock(mutex_);
    return left_unlocked();
}

std::string ProgressDisplay::left_unlocked() const {
    const std::chrono::duration<double> taken = Clock::now() - begun_;
    const double seconds = seconds_left(expected_, taken.count(), fraction_);
    return seconds > 0 ? ", about " + time_text(seconds) + " left" : "";
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
    to_stderr("\r" + progress_line(fraction_, step_ + left_unlocked(), terminal_width(STDERR_FILENO) - 1) + "\x1b[K");
}

}   // namespace meshfolio::run
