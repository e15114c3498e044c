// art/output_file.h: a file that appears whole or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace sikku {

/// Writes beside the target (`.NAME.XXXXXX.tmp` in the same folder) and renames into place on commit; without
/// commit nothing stays. Every failure (missing folder, no permission, full disk) is a std::runtime_error that
/// names the target and the cause; so is a target that is a folder. The new file gets the mode of the one it
/// replaces, or the mode the umask gives.
class OutputFile {
public:
    explicit OutputFile(std::filesystem::path target);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// Buffered (1 MB).
    void write(std::string_view bytes);
    /// Bytes handed over so far.
    std::uint64_t size() const { return written_; }
    /// The temporary file, for a library that opens files by itself. Do not mix with write().
    const std::filesystem::path& temporary() const { return temporary_; }
    /// Flushes and renames. To be called once, last.
    void commit();

private:
    void flush();
    std::filesystem::path target_;
    std::filesystem::path temporary_;
    int descriptor_ = -1;
    std::string buffer_;
    std::uint64_t written_ = 0;
};

}  // namespace sikku
