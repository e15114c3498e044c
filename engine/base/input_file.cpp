#include "engine/base/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace sikku {
namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 16;

[[noreturn]] void fail_reading(const std::string& name, int error) {
    throw std::runtime_error(name + ": " + std::generic_category().message(error));
}

}  // namespace

InputFile::InputFile(const std::filesystem::path& path) {
    const auto fail = [](int error) { throw std::system_error(error, std::generic_category()); };
    struct stat state = {};
    // Opening a pipe and closing it again would break the connection of its writer.
    if (::stat(path.c_str(), &state) != 0) fail(errno);
    if (!S_ISREG(state.st_mode)) fail(EINVAL);
    descriptor_ = Descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
    if (!descriptor_ || ::fstat(descriptor(), &state) != 0) fail(errno);
    if (!S_ISREG(state.st_mode)) fail(EINVAL);
    size_ = static_cast<std::uint64_t>(state.st_size);
}

std::string InputFile::read(std::uint64_t at, std::uint64_t count) const {
    std::string bytes(static_cast<std::size_t>(std::min(count, size_ - std::min(at, size_))), '\0');
    bytes.resize(read(at, bytes.data(), bytes.size()));
    return bytes;
}

std::size_t InputFile::read(std::uint64_t at, char* bytes, std::size_t count) const {
    std::size_t done = 0;
    while (done < count && at + done < size_) {
        const ::ssize_t got = ::pread(descriptor(), bytes + done, count - done, static_cast<::off_t>(at + done));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw std::system_error(errno, std::generic_category());
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
    }
    return done;
}

InputStream::InputStream(const InputFile& file, std::uint64_t begin, std::uint64_t end)
    : file_(file), at_(begin), end_(std::min(end, file.size())) {}

std::string_view InputStream::ahead(std::size_t least) {
    if (block_.size() - next_ < least && at_ < end_) {
        block_.erase(0, next_);
        next_ = 0;
        const std::size_t kept = block_.size();
        const std::size_t wanted = static_cast<std::size_t>(std::min<std::uint64_t>(block_bytes, end_ - at_));
        block_.resize(kept + wanted);
        const std::size_t got = file_.read(at_, block_.data() + kept, wanted);
        block_.resize(kept + got);
        at_ = got == wanted ? at_ + got : end_;  // the file was truncated
    }
    return std::string_view(block_).substr(next_);
}

bool InputStream::skip_past(std::string_view mark) {
    for (;;) {
        const std::string_view bytes = ahead(mark.size());
        if (bytes.size() < mark.size()) return false;
        const std::size_t at = bytes.find(mark);
        if (at != std::string_view::npos) {
            skip(at + mark.size());
            return true;
        }
        // The mark may begin in this block and end in the next.
        skip(bytes.size() - (mark.size() - 1));
    }
}

bool InputStream::skip_text(std::string_view text) {
    if (!ahead(text.size()).starts_with(text)) return false;
    skip(text.size());
    return true;
}

std::string read_stream(std::FILE* stream, const std::string& name, std::size_t most, const Monitor& monitor) {
    std::string text;
    std::string block(std::size_t{1} << 16, '\0');
    while (text.size() <= most) {
        const std::size_t got = std::fread(block.data(), 1, std::min(block.size(), most + 1 - text.size()), stream);
        const int error = errno;
        text.append(block.data(), got);
        monitor.check();
        if (std::ferror(stream) != 0) {
            if (error != EINTR) fail_reading(name, error);
            std::clearerr(stream);
        } else if (got == 0) {
            break;
        }
    }
    return text;
}

std::string read_file(const std::filesystem::path& file, const std::string& name, std::size_t most,
                      const Monitor& monitor) {
    std::error_code unknown;
    if (std::filesystem::is_directory(file, unknown)) throw std::runtime_error(name + " is a folder");
    std::FILE* stream = nullptr;
    // A signal interrupts the wait for the writer of a pipe.
    while (!(stream = std::fopen(file.c_str(), "rb"))) {
        const int error = errno;
        monitor.check();
        if (error != EINTR) fail_reading(name, error);
    }
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> closer(stream, &std::fclose);
    return read_stream(stream, name, most, monitor);
}

}  // namespace sikku
