/// @file
/// Arrays of megabytes, and loops over them on all processors.
#pragma once

#if defined(__linux__) && !defined(MESHFOLIO_PORTABLE)
#include <sys/mman.h>
#endif

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace render {

/// Allocates in large pages, which take a fraction of the time to write for the first time and to read in random order. Elements stay
/// uninitialised unless they are given a value: each is first written by the thread that computes it.
template <class T> struct LargePages : std::allocator<T> {
    template <class U> struct rebind { using other = LargePages<U>; };

    T* allocate(std::size_t count) {
        if (count * sizeof(T) < worth_it) return std::allocator<T>::allocate(count);
        void* const memory = ::operator new (count * sizeof(T), std::align_val_t{page});
#ifdef MADV_HUGEPAGE
        ::madvise(memory, count * sizeof(T) / page * page, MADV_HUGEPAGE);   // only a hint
#endif
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t count) {
        if (count * sizeof(T) < worth_it) return std::allocator<T>::deallocate(memory, count);
        ::operator delete (memory, std::align_val_t{page});
    }
    template <class... Arguments> void construct(T* place, Arguments&&... arguments) {
        if constexpr (sizeof...(Arguments) > 0) ::new (static_cast<void*>(place)) T(std::forward<Arguments>(arguments)...);
    }

private:
    static constexpr std::size_t page = std::size_t{2} << 20, worth_it = 2 * page;
};

template <class T>
requires std::is_trivially_copyable_v<T>
using LargeArray = std::vector<T, LargePages<T>>;

/// Calls body(i) for each i in [0, count) on all processors; calls must not share results.
template <class Body> void for_each_index(std::size_t count, const Body& body) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 16384), [&](const auto& part) {
        for (std::size_t i = part.begin(); i < part.end(); ++i) body(i);
    });
}

}   // namespace render
