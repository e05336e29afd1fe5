/// @file
/// Arrays of megabytes, which threads fill side by side.
#pragma once

#if defined(__linux__) && !defined(MESHFOLIO_PORTABLE)
#include <sys/mman.h>
#endif

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace render {

/// Memory in large pages: writing to it for the first time, and reading it in random order, take a fraction of the time. What is not
/// given a value has none, so that it is first written to by the thread that fills it.
template <class T>
struct LargePages : std::allocator<T> {
    template <class U>
    struct rebind {
        using other = LargePages<U>;
    };

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
    template <class... Arguments>
    void construct(T* place, Arguments&&... arguments) {
        if constexpr (sizeof...(Arguments) > 0) ::new (static_cast<void*>(place)) T(std::forward<Arguments>(arguments)...);
    }

private:
    static constexpr std::size_t page = std::size_t{2} << 20, worth_it = 2 * page;
};

/// Of plain numbers.
template <class T>
requires std::is_trivially_copyable_v<T>
using LargeArray = std::vector<T, LargePages<T>>;

}   // namespace render
