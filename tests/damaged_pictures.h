// tests/damaged_pictures.h: small picture files whose headers contradict their contents.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <random>
#include <string>
#include <vector>

namespace sikku {

/// Numbers as bytes, the first one the most (HEIF) or least (BMP) significant.
std::string big_endian(std::uint64_t value, int bytes);
std::string little_endian(std::uint64_t value, int bytes);

/// A box of ISO/IEC 14496-12, 4.2, and one with a version and flags.
std::string heif_box(const std::string& kind, const std::string& content);
std::string heif_full_box(const std::string& kind, unsigned version, const std::string& content);

/// A HEIF of items that lie over each other (`iovl`, ISO/IEC 23008-12, 6.6.2.4), each on a canvas of that many pixels
/// a side. The first item is the picture.
/// @param parts  numbers, from 1, of the items that each one is made of; empty: coded pixels, which are damaged
std::string heif_of_overlays(const std::vector<std::vector<unsigned>>& parts, std::uint32_t side);

/// The same file with another stated size (`ispe`) of every picture in it.
std::string with_stated_size(std::string heif, std::uint32_t width, std::uint32_t height);

/// A BMP with a header of 40 bytes. @param compression  0 none, 1 runs of 8 bits, 2 runs of 4 bits
std::string bmp_file(std::int32_t width, std::int32_t height, unsigned compression, const std::string& data,
                     unsigned bits = 8);

/// Changes some bytes of a file at random: bits, bytes, numbers of 4 bytes, pieces left out or repeated, and its end.
std::string mutated(std::string bytes, std::mt19937& random);

}  // namespace sikku
