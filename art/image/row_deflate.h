// art/image/row_deflate.h: compresses the rows of a picture (deflate, RFC 1951), most of which repeat a colour.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Compresses pieces of a picture that do not refer to each other. The bytes depend only on the piece, the level and
/// `pixel_bytes`. Runs of a colour cost little more than reading them. Memory: 0.3 MB, kept between pieces.
class RowDeflater {
public:
    /// @param level        1 (fast) to 9 (small)
    /// @param pixel_bytes  bytes of a pixel, 1 to 4
    RowDeflater(int level, std::size_t pixel_bytes);
    RowDeflater(RowDeflater&&) noexcept;
    ~RowDeflater();

    /// Appends the compressed piece to `packed`, up to a whole byte.
    /// @param piece    less than 1 GB
    /// @param is_last  ends the stream
    void compress(std::string_view piece, bool is_last, std::string& packed);

private:
    /// Bytes that repeat those `distance` before them.
    struct Match {
        std::size_t length = 0;  ///< 0: none found
        std::size_t distance = 0;
    };

    struct Places;

    Match find(std::size_t at);
    void remember(std::size_t at);
    void remember_matched(std::size_t at, const Match& match);
    void add_literal(std::size_t at);
    void add_match(Match match);

    std::size_t pixel_bytes_;
    int tries_;                ///< earlier places that are compared
    std::size_t good_length_;  ///< a match of this length is used without looking for a longer one
    bool is_lazy_;             ///< a match is dropped for a longer one that begins a byte later
    bool remembers_all_;       ///< also places in runs of a colour
    std::string_view piece_;
    std::size_t last_distance_ = 0;
    std::size_t remembered_ = 0;  ///< places before this one are remembered, or never will be
    std::unique_ptr<Places> places_;
    std::vector<std::uint32_t> symbols_;  ///< of the block that is being made
    std::array<std::uint32_t, 286> counts_{};
    std::array<std::uint32_t, 30> distance_counts_{};
};

/// The checksum of zlib (RFC 1950) of bytes that follow others with the checksum `before`; 1 if there are none.
std::uint32_t adler32_of(std::uint32_t before, std::string_view bytes);

}  // namespace sikku
