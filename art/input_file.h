// art/input_file.h: files that strangers may have made, read piece by piece.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace sikku {

/// A regular file, open for reading. No read takes more memory than the file has bytes there, whatever the file
/// states about itself.
class InputFile {
public:
    /// Does not open pipes and devices, which might wait.
    /// @throws std::system_error if the file cannot be opened or is not a regular file
    explicit InputFile(const std::filesystem::path& path);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    /// Bytes when it was opened.
    std::uint64_t size() const { return size_; }
    /// The bytes from `at` on, at most `count`; fewer where the file ends.
    /// @throws std::system_error if they cannot be read
    std::string read(std::uint64_t at, std::uint64_t count) const;
    /// The same into `bytes`; returns how many there are.
    std::size_t read(std::uint64_t at, char* bytes, std::size_t count) const;

private:
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

/// The bytes of a file from `begin` to `end`, one after the other, through a block of 64 kB.
class InputStream {
public:
    InputStream(const InputFile& file, std::uint64_t begin, std::uint64_t end);

    /// The next bytes without moving on: at least `least` (up to 64) of them unless the end comes first, and as many
    /// as there are in memory. Valid until the next call.
    std::string_view ahead(std::size_t least = 1);
    /// Moves on by `count` bytes, but not beyond what ahead() returned.
    void skip(std::size_t count) { next_ += std::min(count, block_.size() - next_); }
    /// The next byte, or -1 at the end; moves on.
    int take() {
        const std::string_view bytes = ahead();
        if (bytes.empty()) return -1;
        skip(1);
        return static_cast<unsigned char>(bytes.front());
    }
    /// Moves behind the next `mark` (1 to 64 bytes); false if there is none before the end. Cost: a search.
    bool skip_past(std::string_view mark);
    /// Moves on by `text` if it comes next.
    bool skip_text(std::string_view text);

private:
    const InputFile& file_;
    std::uint64_t at_, end_;  // of what was not read yet
    std::string block_;
    std::size_t next_ = 0;
};

}  // namespace sikku
