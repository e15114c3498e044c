// art/decoder/decoder.cpp: the programs that decode untrusted pictures, in a process that can do nothing else.
#include "art/decoder/decoder.h"

#include "art/decoder/confinement.h"
#include "art/image/decoder_answer.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sikku {
namespace {

/// Maximum size of a file in bytes.
constexpr std::size_t most_file_bytes = 256'000'000;

void send(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(STDOUT_FILENO, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) ::_exit(1);
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
}

void send(DecoderAnswer answer) {
    const char byte = static_cast<char>(answer);
    send(std::string_view(&byte, 1));
}

[[noreturn]] void end_without_memory() {
    send(DecoderAnswer::memory);
    ::_exit(1);
}

std::string read_input() {
    std::string bytes;
    std::size_t held = 0;
    for (;;) {
        constexpr std::size_t block = std::size_t{1} << 20U;
        if (bytes.size() - held < block) bytes.resize(std::max(2 * bytes.size(), 2 * block));
        const ssize_t got = ::read(STDIN_FILENO, bytes.data() + held, bytes.size() - held);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw std::runtime_error("the picture cannot be read");
        held += static_cast<std::size_t>(got);
        if (held > most_file_bytes) throw std::runtime_error("the picture is larger than 256 MB");
        if (got == 0) break;
    }
    bytes.resize(held);
    return bytes;
}

void answer(int longest_side, std::uint64_t most_pixels) {
    try {
        const DecodedPicture picture = decode(read_input(), longest_side, most_pixels);
        std::string head;
        for (const int number : {picture.width, picture.height, picture.file_width, picture.file_height}) {
            for (unsigned shift = 0; shift < 32; shift += 8) {
                head += static_cast<char>(static_cast<std::uint32_t>(number) >> shift);
            }
        }
        send(DecoderAnswer::picture);
        send(head);
        send({reinterpret_cast<const char*>(picture.pixels.data()), picture.pixels.size()});
    } catch (const std::bad_alloc&) {
        end_without_memory();
    } catch (const std::exception& error) {
        send(DecoderAnswer::refusal);
        send(std::string_view(error.what()).substr(0, longest_refusal));
    }
}

template <typename Number>
Number number(const char* text) {
    Number value = 0;
    const std::string_view digits = text;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size()) throw std::runtime_error("expected a number");
    return value;
}

}  // namespace
}  // namespace sikku

#if defined(__GLIBC__) && !defined(SIKKU_SANITIZED)
// C decoders react to failed allocations in any way from a message to a crash; here the first failure is reported.
// These replace the functions of the C library in all libraries of the process.
extern "C" {
// NOLINTBEGIN(bugprone-reserved-identifier): names of the C library
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
// NOLINTEND(bugprone-reserved-identifier)
}
namespace {
bool is_confined = false;
void* require(void* memory, bool is_wanted = true) {
    if (!memory && is_wanted && is_confined) sikku::end_without_memory();
    return memory;
}
}  // namespace
extern "C" {
void* malloc(std::size_t size) {
    return require(__libc_malloc(size));
}
void* calloc(std::size_t count, std::size_t size) {
    return require(__libc_calloc(count, size));
}
void* realloc(void* memory, std::size_t size) {
    return require(__libc_realloc(memory, size), size > 0);
}
void* memalign(std::size_t alignment, std::size_t size) {
    return require(__libc_memalign(alignment, size));
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
    return require(__libc_memalign(alignment, size));
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
    *memory = require(__libc_memalign(alignment, size));
    return *memory ? 0 : ENOMEM;
}
}
#else
namespace {
bool is_confined = false;
}
#endif

int main(int count, char** arguments) {
    using namespace sikku;
    try {
        if (count != 5 || number<std::uint64_t>(arguments[1]) != decoder_version(SIKKU_VERSION)) {
            send(DecoderAnswer::version);
            return 1;
        }
        const int parent = number<int>(arguments[2]);
        const int longest_side = number<int>(arguments[3]);
        const std::uint64_t most_pixels = number<std::uint64_t>(arguments[4]);
        prepare_decoder();
        confine({most_decoder_memory, most_decoder_seconds}, parent);
        is_confined = true;
        send(DecoderAnswer::ready);
        answer(longest_side, most_pixels);
    } catch (const std::exception&) {
        ::_exit(1);
    }
    // The libraries need no cleanup.
    ::_exit(0);
}
