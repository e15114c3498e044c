// engine/base/input_file.h: reads untrusted files piece by piece.
#pragma once

#include "engine/base/child_process.h"
#include "engine/base/monitor.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace sikku {

/// Receives the name and the text of a file that was read.
using FileWitness = std::function<void(const std::string& name, const std::string& text)>;

/// A regular file, open for reading. No read allocates more memory than the bytes present, whatever sizes the file
/// claims.
class InputFile {
public:
    /// Does not open pipes and devices, which might block.
    /// @throws std::system_error if the file cannot be opened or is not a regular file
    explicit InputFile(const std::filesystem::path& path);

    /// Size in bytes when it was opened.
    std::uint64_t size() const { return size_; }
    /// Reads at most `count` bytes from `at` on; fewer at the end of the file.
    /// @throws std::system_error if they cannot be read
    std::string read(std::uint64_t at, std::uint64_t count) const;
    /// Reads into `bytes`; returns the number of bytes read.
    std::size_t read(std::uint64_t at, char* bytes, std::size_t count) const;

    /// A descriptor for another process; open as long as this object.
    int descriptor() const { return descriptor_.get(); }

private:
    Descriptor descriptor_;
    std::uint64_t size_ = 0;
};

/// Reads the bytes of a file from `begin` to `end` sequentially, through a block of 64 kB.
class InputStream {
public:
    InputStream(const InputFile& file, std::uint64_t begin, std::uint64_t end);

    /// Returns the next bytes without consuming them: at least `least` (up to 64) unless the end comes first, and as
    /// many as are in memory. Valid until the next call.
    std::string_view ahead(std::size_t least = 1);
    /// Skips `count` bytes, but not beyond what ahead() returned.
    void skip(std::size_t count) { next_ += std::min(count, block_.size() - next_); }
    /// Takes the next byte; -1 at the end.
    int take() {
        const std::string_view bytes = ahead();
        if (bytes.empty()) return -1;
        skip(1);
        return static_cast<unsigned char>(bytes.front());
    }
    /// Skips past the next `mark` (1 to 64 bytes); false if there is none before the end. Cost: a search.
    bool skip_past(std::string_view mark);
    /// Skips `text` and returns true if it comes next.
    bool skip_text(std::string_view text);

private:
    const InputFile& file_;
    std::uint64_t at_, end_;  // bounds of the unread part
    std::string block_;
    std::size_t next_ = 0;
};

/// Reads an open stream to its end, at most `most` + 1 bytes. Signals interrupt waiting, not reading.
/// @param name  for messages
/// @throws std::runtime_error; Stopped
std::string read_stream(std::FILE* stream, const std::string& name, std::size_t most, const Monitor& monitor = {});

/// Reads a file likewise; waits for the writer of a named pipe.
/// @throws std::runtime_error if it is a folder or cannot be read; Stopped
std::string read_file(const std::filesystem::path& file, const std::string& name, std::size_t most,
                      const Monitor& monitor = {});

}  // namespace sikku
