/// @file
/// Progress of long commands on stderr: a bar on a terminal, elsewhere a line for each finished part.
#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

namespace meshfolio::run {

/// Shows the progress of a command on stderr. Thread-safe; never throws.
class ProgressDisplay {
public:
    /// @param terminal  draw a bar, at most ten times a second
    /// @param expected  seconds the whole will take; 0: not known before something is done
    explicit ProgressDisplay(bool terminal, double expected = 0);
    ~ProgressDisplay();   // leaves a clean line
    ProgressDisplay(const ProgressDisplay&) = delete;
    ProgressDisplay& operator=(const ProgressDisplay&) = delete;

    /// Sets the share that is done, in [0, 1].
    void advance(double fraction);
    /// Sets the current step, "q4: eigenpairs of armadillo", which only a terminal shows.
    void step(std::string_view what);
    /// Reports a finished part: prints it as a line, or on a terminal shows it as the current step.
    void milestone(std::string_view what);
    /// Returns ", about 40 s left", by seconds_left(); empty if that is not known.
    std::string left() const;

private:
    using Clock = std::chrono::steady_clock;
    const bool terminal_;
    const double expected_;
    const Clock::time_point begun_ = Clock::now();
    mutable std::mutex mutex_;
    double fraction_ = 0;
    std::string step_;
    Clock::time_point drawn_at_{};
    bool drawn_ = false;
    void draw(bool now);
    std::string left_unlocked() const;
};

/// Returns the remaining time (1 − f)((1 − f) expected + taken) [s] for the share f that is done: at first from the estimate, later from
/// the time taken. If `expected` is 0, (1 − f) taken / f, and 0 if f is 0.
double seconds_left(double expected, double taken, double fraction);

/// Returns a time as text: "40 s" below 100 s and "12 min" below 100 min, rounded up, else "3.5 h".
std::string time_text(double seconds);

/// A stage of a command, for as long as the object lives. After two seconds, a terminal shows the innermost stage and the time taken:
/// "inspect: reading bunny.off, 12 s". Nothing is shown without a terminal or while a ProgressDisplay is there. Stages are nested and
/// belong to one thread; any thread may call advance().
class Stage {
public:
    explicit Stage(const std::string& what);
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    /// Sets the share that is done, in [0, 1].
    void advance(double fraction);

private:
    std::size_t depth_;
};

/// Returns "inspect: reading bunny.off, 45 %, 12 s", shortened to `width` columns; without the share if `fraction` is negative.
std::string stage_line(std::string_view what, double fraction, int seconds, int width);

/// Erases the stage line on the terminal, before other text is written.
void make_room_on_terminal();

/// Returns "[#########···········]  45 %  q4: 150 eigenpairs", shortened to `width` columns (code points).
std::string progress_line(double fraction, std::string_view step, int width);

/// Returns true if stderr is a terminal that can redraw a line.
bool stderr_is_terminal();

}   // namespace meshfolio::run
