// engine/base/memory.h: the memory of the machine, and sizes in the notation of users.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace sikku {

/// Bytes of memory available without swapping; 4 GB if the system does not report it.
std::uint64_t available_memory();

/// Asks the system to use large pages for memory that will be filled from its beginning: it is then faster to fill,
/// and to access in any order. Does nothing for less than 4 MB, or if the system cannot do it.
void use_large_pages(void* begin, std::size_t bytes);
/// The same for the memory that a vector has reserved.
template <class Element>
void use_large_pages(std::vector<Element>& list) {
    use_large_pages(list.data(), list.capacity() * sizeof(Element));
}
/// Resizes a vector in large pages.
template <class Element>
void resize_in_large_pages(std::vector<Element>& list, std::size_t size, const Element& value = {}) {
    list.reserve(size);
    use_large_pages(list);
    list.resize(size, value);
}

/// Parses a size in bytes: `1G`, `512M`, `2GiB`, `500MB`, any case; k, M, G and T are powers of 1024. Nullopt for
/// anything else, and for 0.
std::optional<double> parse_bytes(std::string_view text);

}  // namespace sikku
