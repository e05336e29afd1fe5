#pragma once
// Stands in for oneTBB where ThreadSanitizer watches (preset thread puts this folder before /usr/include).
//
// The distribution's libtbb is not instrumented: the sanitizer does not see how it hands work over, and reports every result that one
// thread makes and another reads. Suppressing that would also silence our own races, since both pass through the same functions. So our
// code is compiled against this small scheduler, of which the sanitizer sees everything: what oneTBB promises and not more. Work begins
// after the call and ends before it returns; between two pieces of one loop there is no order at all (all counters here are relaxed).
//
// Only what src/, render/ and tests/ use is here. oneTBB itself and its stealing are not tested by this.
#include <algorithm>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <utility>
#include <vector>

namespace tbb {

namespace scheduler {

/// More threads than most machines that run this have: the sanitizer needs two that meet, not two processors.
inline constexpr int default_threads = 4;

inline std::atomic<int> allowed = default_threads;   // by global_control
inline std::atomic<int> busy = 1;                    // the main thread and all helpers
inline thread_local int arena_threads = default_threads;

inline int threads_here() { return std::max(1, std::min(arena_threads, allowed.load(std::memory_order_relaxed))); }

inline bool take_thread() {
    if (busy.fetch_add(1, std::memory_order_relaxed) < allowed.load(std::memory_order_relaxed)) return true;
    busy.fetch_sub(1, std::memory_order_relaxed);
    return false;
}

inline void give_thread_back() { busy.fetch_sub(1, std::memory_order_relaxed); }

/// The first exception of several threads; thrown again by the one that waits for them.
class Failure {
public:
    template <class Work> void guard(const Work& work) {
        try {
            work();
        } catch (...) {
            const std::lock_guard lock(mutex_);
            if (!first_) first_ = std::current_exception();
            happened_.store(true, std::memory_order_relaxed);
        }
    }
    [[nodiscard]] bool happened() const { return happened_.load(std::memory_order_relaxed); }
    void rethrow() {
        if (const std::exception_ptr first = std::exchange(first_, nullptr)) std::rethrow_exception(first);
    }

private:
    std::mutex mutex_;
    std::exception_ptr first_;
    std::atomic<bool> happened_ = false;
};

/// piece(i) for all i in [0, count), by as many threads as are free. Each thread has its own pieces from the start, neighbours
/// different threads: dealt out as they finish, one thread might be through before the next has begun, and no race be seen.
template <class Piece> void run_pieces(std::size_t count, const Piece& piece) {
    const int limit = threads_here();
    std::size_t threads = 1;
    while (threads < static_cast<std::size_t>(limit) && threads < count && take_thread()) ++threads;

    Failure failure;
    const auto work = [&](std::size_t thread) {
        failure.guard([&] {
            for (std::size_t i = thread; i < count && !failure.happened(); i += threads) piece(i);
        });
    };
    std::vector<std::thread> helpers;
    for (std::size_t t = 1; t < threads; ++t) {
        helpers.emplace_back([&, t] {
            arena_threads = limit;
            work(t);
        });
    }
    work(0);
    for (std::thread& helper : helpers) {
        helper.join();
        give_thread_back();
    }
    failure.rethrow();
}

}   // namespace scheduler

struct static_partitioner {};
struct simple_partitioner {};
struct auto_partitioner {};

template <class Value> class blocked_range {
public:
    blocked_range(Value begin, Value end, std::size_t grain = 1) : begin_(begin), end_(end), grain_(grain) {}
    Value begin() const { return begin_; }
    Value end() const { return end_; }
    std::size_t size() const { return begin_ < end_ ? static_cast<std::size_t>(end_ - begin_) : 0; }
    std::size_t grainsize() const { return grain_; }
    bool empty() const { return size() == 0; }

    /// How many pieces of at most grainsize() there are, and the i-th of them.
    std::size_t pieces() const { return (size() + grain_ - 1) / grain_; }
    blocked_range piece(std::size_t i) const {
        const std::size_t first = i * grain_, last = std::min(size(), first + grain_);
        return blocked_range(static_cast<Value>(begin_ + first), static_cast<Value>(begin_ + last), grain_);
    }

private:
    Value begin_, end_;
    std::size_t grain_;
};

template <class Value, class Body, class... Partitioner>
void parallel_for(const blocked_range<Value>& range, const Body& body, const Partitioner&...) {
    scheduler::run_pieces(range.pieces(), [&](std::size_t i) { body(range.piece(i)); });
}

template <std::integral First, std::integral Last, class Body, class... Partitioner>
void parallel_for(First first, Last last, const Body& body, const Partitioner&...) {
    if (!(first < last)) return;
    // Neighbours go to different threads; of very long loops, neighbouring runs do.
    const auto count = static_cast<std::size_t>(last - first);
    const blocked_range<First> all(first, static_cast<First>(last), 1 + count / 4096);
    scheduler::run_pieces(all.pieces(), [&](std::size_t i) {
        const auto part = all.piece(i);
        for (First j = part.begin(); j < part.end(); ++j) body(j);
    });
}

template <class Value, class Result, class Body, class Join>
Result parallel_reduce(const blocked_range<Value>& range, const Result& identity, const Body& body, const Join& join) {
    std::deque<Result> parts(range.pieces(), identity);   // not a vector: of bool it would be packed
    scheduler::run_pieces(range.pieces(), [&](std::size_t i) { parts[i] = body(range.piece(i), identity); });
    Result sum = identity;
    for (const Result& part : parts) sum = join(sum, part);
    return sum;
}

template <class... Work> void parallel_invoke(const Work&... work) {
    const std::vector<std::function<void()>> all{std::cref(work)...};
    scheduler::run_pieces(all.size(), [&](std::size_t i) { all[i](); });
}

class task_group {
public:
    task_group() = default;
    task_group(const task_group&) = delete;
    task_group& operator=(const task_group&) = delete;
    ~task_group() { join(); }

    template <class Work> void run(Work work) {
        if (scheduler::threads_here() == 1 || !scheduler::take_thread()) return failure_.guard(work);
        helpers_.emplace_back([this, work = std::move(work)] { failure_.guard(work); });
    }
    void wait() {
        join();
        failure_.rethrow();
    }

private:
    void join() {
        for (std::thread& helper : helpers_) {
            helper.join();
            scheduler::give_thread_back();
        }
        helpers_.clear();
    }
    scheduler::Failure failure_;
    std::vector<std::thread> helpers_;
};

class task_arena {
public:
    static constexpr int automatic = -1;
    explicit task_arena(int threads = automatic) : threads_(threads == automatic ? scheduler::threads_here() : threads) {}
    int max_concurrency() const { return threads_; }

    template <class Work> auto execute(Work&& work) {
        const Entered entered(threads_);
        return std::forward<Work>(work)();
    }

private:
    struct Entered {
        explicit Entered(int threads) : before(std::exchange(scheduler::arena_threads, threads)) {}
        Entered(const Entered&) = delete;
        Entered& operator=(const Entered&) = delete;
        ~Entered() { scheduler::arena_threads = before; }
        int before;
    };
    int threads_;
};

namespace this_task_arena {
inline int max_concurrency() { return scheduler::threads_here(); }
template <class Work> auto isolate(Work&& work) { return std::forward<Work>(work)(); }
}   // namespace this_task_arena

class global_control {
public:
    enum parameter { max_allowed_parallelism };
    global_control(parameter, std::size_t threads) : before_(scheduler::allowed.exchange(static_cast<int>(threads))) {}
    global_control(const global_control&) = delete;
    global_control& operator=(const global_control&) = delete;
    ~global_control() { scheduler::allowed = before_; }

private:
    int before_;
};

/// One value for each thread that asks. A thread takes the lock only the first time: locking always would put the pieces in an order.
template <class Value> class enumerable_thread_specific {
public:
    template <class Make> explicit enumerable_thread_specific(Make make) : make_(std::move(make)) {}

    Value& local() {
        static thread_local std::unordered_map<std::uint64_t, Value*> known;
        Value*& mine = known[number_];
        if (!mine) {
            const std::lock_guard lock(mutex_);
            mine = &values_.emplace_back(make_());
        }
        return *mine;
    }

private:
    static inline std::atomic<std::uint64_t> last_number_ = 0;
    const std::uint64_t number_ = ++last_number_;
    std::function<Value()> make_;
    std::mutex mutex_;
    std::deque<Value> values_;
};

}   // namespace tbb
