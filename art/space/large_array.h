// art/space/large_array.h: numbers in large pages of memory.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace sikku {

/// Uninitialised memory for many numbers, in pages of 2 MB where the system supports them: random reads then miss the
/// processor's TLB less often, and the system has fewer pages to provide.
template <class Number>
class LargeArray {
public:
    LargeArray() = default;
    explicit LargeArray(std::size_t size) : size_(size) {
        constexpr std::size_t page = std::size_t{1} << 21;
        const std::size_t bytes = (size * sizeof(Number) + page - 1) / page * page;
        if (bytes == 0) return;
        numbers_.reset(static_cast<Number*>(std::aligned_alloc(page, bytes)));
        if (!numbers_) throw std::bad_alloc();
#if defined(MADV_HUGEPAGE)
        madvise(numbers_.get(), bytes, MADV_HUGEPAGE);
#endif
    }
    std::span<Number> part(std::size_t first, std::size_t count) {
        return std::span(numbers_.get(), size_).subspan(first, count);
    }

private:
    struct Free {
        void operator()(Number* numbers) const { std::free(numbers); }
    };
    std::unique_ptr<Number[], Free> numbers_;
    std::size_t size_ = 0;
};

}  // namespace sikku
