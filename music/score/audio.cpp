#include "music/score/audio.h"

#include "music/score/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace sikku {
namespace {

using namespace child;

namespace fs = std::filesystem;

constexpr int rate = 44'100;  // frames a second
constexpr std::size_t channels = 2;
constexpr std::size_t block_frames = 4096;
constexpr std::string_view advice = "apt install fluidsynth timgm6mb-soundfont";

static_assert(std::endian::native == std::endian::little, "samples are handed over as little-endian floats");

/// Writes bytes to the end of the file of the sound.
using Write = std::function<void(std::string_view bytes)>;

// ---- fluidsynth

/// Sound as 32-bit floats, left and right in turn, in a nameless file.
struct Rendering {
    Descriptor file;
    fs::path name;  ///< for messages
    std::uint64_t frames = 0;
    float peak = 0.0F;
};

Rendering render(const fs::path& midi, const fs::path& output, const fs::path& shown, const AudioWatch& watch) {
    const std::optional<fs::path> program = find_program("fluidsynth");
    if (!program) fail_without("sound", "fluidsynth", fmt::format(" and a soundfont: {}", advice));
    const fs::path soundfont = find_soundfont();
    // fluidsynth does not report files that it cannot read, and interprets names with a dash as options.
    if (!is_readable_file(midi)) fail(midi, "read", errno != 0 ? errno : ENOENT);
    Rendering rendering;
    rendering.name = shown;
    rendering.file = nameless_file(output);
    const Descriptor messages = lifted(nameless_file(output));
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe2");
    const Descriptor source(ends[0]);
    Descriptor drain = lifted(Descriptor(ends[1]));

    // Ignores the user's settings, so that the result is the same everywhere. A chorus would blur microtones. Floats
    // do not clip at any gain.
    std::istringstream options(
        fmt::format("-n -i -q -f /dev/null -C 0 -R 1 -g 0.5 -r {} -T raw -O float -E little -F /dev/fd/3", rate));
    std::vector<std::string> arguments{std::istream_iterator<std::string>(options), {}};
    arguments.push_back(fs::absolute(soundfont).string());
    arguments.push_back(fs::absolute(midi).string());
    Process process({.program = *program,
                     .arguments = std::move(arguments),
                     .descriptors = {-1, messages.get(), messages.get(), drain.get()}});
    drain.reset();

    const auto failed = [&](std::string_view why) {
        const std::string words = last_words(messages.get(), "fluidsynth");
        return std::runtime_error(fmt::format("fluidsynth {}{}{}", why, words.empty() ? "" : ":\n", words));
    };
    constexpr std::uint64_t frame_bytes = channels * sizeof(float);
    // Sizes in a WAV file have 32 bits.
    constexpr std::uint64_t most_frames = (std::numeric_limits<std::uint32_t>::max() - 64) / (channels * 2);
    std::vector<float> block(block_frames * channels);
    char* const bytes = reinterpret_cast<char*>(block.data());
    std::size_t filled = 0;  // bytes of the block
    std::uint64_t next_watch = 0;
    constexpr int watch_milliseconds = 100;
    while (true) {
        // A soundfont may take seconds to load.
        pollfd waiting{source.get(), POLLIN, 0};
        if (::poll(&waiting, 1, watch_milliseconds) <= 0) {
            if (watch) watch(static_cast<double>(rendering.frames) / rate);
            continue;
        }
        const ssize_t got = ::read(source.get(), bytes + filled, block.size() * sizeof(float) - filled);
        if (got < 0) {
            if (errno == EINTR) continue;
            throw std::system_error(errno, std::generic_category(), "reading the sound of fluidsynth");
        }
        filled += static_cast<std::size_t>(got);
        if (got > 0 && filled < block.size() * sizeof(float)) continue;
        const std::size_t frames = filled / frame_bytes;
        for (std::size_t i = 0; i < frames * channels; ++i) {
            const float size = std::abs(block[i]);
            // Also false for NaN.
            if (!(size < 1e6F)) throw failed("gave no readable sound; is it built with libsndfile?");
            rendering.peak = std::max(rendering.peak, size);
        }
        write_all(rendering.file.get(), bytes, frames * frame_bytes, shown);
        rendering.frames += frames;
        if (rendering.frames > most_frames) {
            throw std::runtime_error("the music is too long to become sound: a WAV file holds 6 hours 45 minutes");
        }
        // Also at the end: a signal that interrupts this program ends fluidsynth too, which is then not a failure.
        if (watch && (got == 0 || rendering.frames >= next_watch)) {
            watch(static_cast<double>(rendering.frames) / rate);
            next_watch = rendering.frames + std::uint64_t{20} * rate;
        }
        if (got == 0) break;
        filled = 0;
    }
    const int status = process.wait();
    if (WIFSIGNALED(status)) throw failed(fmt::format("was ended by signal {}", WTERMSIG(status)));
    if (WEXITSTATUS(status) != 0) throw failed(fmt::format("failed with status {}", WEXITSTATUS(status)));
    // fluidsynth reports success even if it could not read the soundfont or the MIDI file.
    const std::string words = last_words(messages.get(), "fluidsynth");
    if (rendering.frames == 0) throw failed("rendered nothing");
    for (const std::string_view mark : {"error:", "panic:", "not a SoundFont or MIDI file"}) {
        if (words.find(mark) != std::string::npos) throw failed("failed");
    }
    return rendering;
}

// ---- samples

/// Reads a rendering from the front as 16-bit samples with the peak at -1 dBFS.
class Samples {
public:
    explicit Samples(const Rendering& rendering) : rendering_(rendering), floats_(block_frames * channels) {
        // 10^(-1/20). The quietest sound is far above the noise of the arithmetic.
        constexpr double minus_one_decibel = 0.8912509381337456;
        constexpr float silence = 1e-6F;
        scale_ = rendering.peak > silence ? 32768.0 * minus_one_decibel / static_cast<double>(rendering.peak) : 0.0;
    }

    /// The next frames, at most block_frames; none at the end. Valid until the next call.
    const std::vector<std::int16_t>& next() {
        const std::uint64_t left = rendering_.frames - position_;
        const auto frames = static_cast<std::size_t>(std::min<std::uint64_t>(left, block_frames));
        const std::size_t bytes = frames * channels * sizeof(float);
        if (read_at(rendering_.file.get(), reinterpret_cast<char*>(floats_.data()), bytes,
                    position_ * channels * sizeof(float), rendering_.name) != bytes) {
            fail(rendering_.name, "read back", EIO);
        }
        position_ += frames;
        samples_.resize(frames * channels);
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            samples_[i] = static_cast<std::int16_t>(std::lround(static_cast<double>(floats_[i]) * scale_));
        }
        return samples_;
    }

private:
    const Rendering& rendering_;
    double scale_ = 0.0;
    std::uint64_t position_ = 0;  ///< frames
    std::vector<float> floats_;
    std::vector<std::int16_t> samples_;
};

void put_little(std::string& out, std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 0xFF);
}

/// Writes samples as in a WAV file.
void put_samples(std::string& out, const std::vector<std::int16_t>& samples) {
    out.clear();
    for (const std::int16_t sample : samples) put_little(out, static_cast<std::uint16_t>(sample), 2);
}

void write_wav(const Rendering& rendering, const Write& write) {
    const std::uint64_t bytes = rendering.frames * channels * 2;
    std::string text = "RIFF";
    put_little(text, 36 + bytes, 4);
    text += "WAVEfmt ";
    put_little(text, 16, 4);
    put_little(text, 1, 2);  // PCM
    put_little(text, channels, 2);
    put_little(text, rate, 4);
    put_little(text, rate * channels * 2, 4);
    put_little(text, channels * 2, 2);
    put_little(text, 16, 2);
    text += "data";
    put_little(text, bytes, 4);
    write(text);
    Samples samples(rendering);
    while (true) {
        const std::vector<std::int16_t>& block = samples.next();
        if (block.empty()) break;
        put_samples(text, block);
        write(text);
    }
}

// ---- FLAC

/// The checksum MD5. Source: RFC 1321.
class Md5 {
public:
    void add(std::string_view bytes) {
        length_ += bytes.size();
        buffer_ += bytes;
        std::size_t at = 0;
        for (; buffer_.size() - at >= 64; at += 64) block(buffer_.data() + at);
        buffer_.erase(0, at);
    }
    std::string finish() {
        const std::uint64_t bits = length_ * 8;
        std::string tail = "\x80";
        while ((length_ + tail.size()) % 64 != 56) tail += '\0';
        put_little(tail, bits, 8);
        add(tail);
        std::string digest;
        for (const std::uint32_t word : state_) put_little(digest, word, 4);
        return digest;
    }

private:
    void block(const char* bytes) {
        static constexpr std::array<int, 16> shifts = {7, 12, 17, 22, 5, 9, 14, 20, 4, 11, 16, 23, 6, 10, 15, 21};
        static const std::array<std::uint32_t, 64> sines = [] {
            std::array<std::uint32_t, 64> table{};
            for (std::size_t i = 0; i < 64; ++i) {
                table[i] = static_cast<std::uint32_t>(
                    std::floor(4294967296.0 * std::abs(std::sin(static_cast<double>(i + 1)))));
            }
            return table;
        }();
        std::array<std::uint32_t, 16> words{};
        for (std::size_t i = 0; i < 64; ++i) {
            words[i / 4] |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i])) << (8 * (i % 4));
        }
        auto [a, b, c, d] = state_;
        for (std::size_t i = 0; i < 64; ++i) {
            std::uint32_t mixed = 0;
            std::size_t word = 0;
            switch (i / 16) {
                case 0:
                    mixed = (b & c) | (~b & d);
                    word = i;
                    break;
                case 1:
                    mixed = (d & b) | (~d & c);
                    word = (5 * i + 1) % 16;
                    break;
                case 2:
                    mixed = b ^ c ^ d;
                    word = (3 * i + 5) % 16;
                    break;
                default:
                    mixed = c ^ (b | ~d);
                    word = 7 * i % 16;
            }
            const std::uint32_t sum = a + mixed + sines[i] + words[word];
            a = d;
            d = c;
            c = b;
            b += std::rotl(sum, shifts[4 * (i / 16) + i % 4]);
        }
        state_[0] += a;
        state_[1] += b;
        state_[2] += c;
        state_[3] += d;
    }

    std::array<std::uint32_t, 4> state_ = {0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476};
    std::uint64_t length_ = 0;
    std::string buffer_;
};

/// Writes bits, the highest first.
class Bits {
public:
    /// Appends the lowest `count` bits of `value`, at most 32.
    void put(std::uint32_t value, int count) {
        if (count == 0) return;
        const std::uint64_t mask = (std::uint64_t{1} << count) - 1;
        held_ = held_ << count | (value & mask);
        holding_ += count;
        while (holding_ >= 8) {
            holding_ -= 8;
            bytes_ += static_cast<char>(held_ >> holding_ & 0xFF);
        }
    }
    void put_zeros(std::uint32_t count) {
        for (; count > 24; count -= 24) put(0, 24);
        put(0, static_cast<int>(count));
    }
    void fill_byte() {
        if (holding_ > 0) put(0, 8 - holding_);
    }
    std::string& bytes() { return bytes_; }

private:
    std::uint64_t held_ = 0;
    int holding_ = 0;
    std::string bytes_;
};

std::uint32_t crc(std::string_view bytes, int width, std::uint32_t polynomial) {
    const std::uint32_t top = 1U << (width - 1);
    std::uint32_t value = 0;
    for (const char byte : bytes) {
        value ^= static_cast<std::uint32_t>(static_cast<unsigned char>(byte)) << (width - 8);
        for (int i = 0; i < 8; ++i) value = (value & top) != 0 ? value << 1 ^ polynomial : value << 1;
    }
    return value & (top | (top - 1));
}

/// One channel of one block: a fixed predictor and its residuals in Rice codes.
struct Subframe {
    std::size_t order = 0;
    int partition_order = 0;
    std::vector<std::uint32_t> folded;  ///< residuals from `order` on: 0, -1, 1, -2, …
    std::vector<int> parameters;        ///< Rice parameter of each partition
    std::uint64_t bits = 0;             ///< without its head
};

/// The Rice parameter with the fewest bits for numbers with this sum (within a bit each), and that number of bits.
std::pair<int, std::uint64_t> rice_parameter(std::uint64_t sum, std::uint64_t count) {
    constexpr int most = 14;
    int best = 0;
    std::uint64_t bits = std::numeric_limits<std::uint64_t>::max();
    for (int k = 0; k <= most; ++k) {
        const std::uint64_t needed = count * static_cast<std::uint64_t>(k + 1) + (sum >> k);
        if (needed < bits) {
            bits = needed;
            best = k;
        }
    }
    return {best, bits};
}

Subframe predicted(const std::vector<std::int32_t>& samples, int sample_bits) {
    constexpr std::size_t most_order = 4;
    const std::size_t count = samples.size();
    // Differences of increasing order; the order with the smallest sum is chosen.
    std::array<std::uint64_t, most_order + 1> sums{};
    std::array<std::int32_t, most_order + 1> last{};
    for (std::size_t i = 0; i < count; ++i) {
        std::int32_t value = samples[i];
        for (std::size_t order = 0; order <= most_order; ++order) {
            if (i >= most_order) sums[order] += static_cast<std::uint64_t>(std::abs(value));
            const std::int32_t difference = value - last[order];
            last[order] = value;
            value = difference;
        }
    }
    Subframe subframe;
    if (count > most_order) {
        subframe.order = static_cast<std::size_t>(std::min_element(sums.begin(), sums.end()) - sums.begin());
    }
    std::vector<std::int32_t> residuals = samples;
    for (std::size_t order = 0; order < subframe.order; ++order) {
        for (std::size_t i = count; i-- > order + 1;) residuals[i] -= residuals[i - 1];
    }
    subframe.folded.reserve(count);
    for (std::size_t i = subframe.order; i < count; ++i) {
        const std::int32_t value = residuals[i];
        subframe.folded.push_back(static_cast<std::uint32_t>(value) << 1 ^ static_cast<std::uint32_t>(value >> 31));
    }
    subframe.bits = std::numeric_limits<std::uint64_t>::max();
    for (int partition_order = 0; partition_order <= 6; ++partition_order) {
        const std::size_t partitions = std::size_t{1} << partition_order;
        if (count % partitions != 0 || count / partitions <= subframe.order) break;
        std::vector<int> parameters;
        std::uint64_t bits = 0;
        std::size_t at = 0;
        for (std::size_t p = 0; p < partitions; ++p) {
            const std::size_t until = (p + 1) * (count / partitions) - subframe.order;
            std::uint64_t sum = 0;
            const std::size_t begin = at;
            for (; at < until; ++at) sum += subframe.folded[at];
            const auto [parameter, needed] = rice_parameter(sum, until - begin);
            parameters.push_back(parameter);
            bits += 4 + needed;
        }
        if (bits < subframe.bits) {
            subframe.bits = bits;
            subframe.partition_order = partition_order;
            subframe.parameters = std::move(parameters);
        }
    }
    subframe.bits += subframe.order * static_cast<std::size_t>(sample_bits);
    return subframe;
}

void put_subframe(Bits& out, const std::vector<std::int32_t>& samples, int sample_bits, const Subframe& subframe) {
    const auto put_sample = [&](std::int32_t value) { out.put(static_cast<std::uint32_t>(value), sample_bits); };
    if (std::all_of(samples.begin(), samples.end(), [&](std::int32_t value) { return value == samples.front(); })) {
        out.put(0b00000000, 8);  // constant
        put_sample(samples.front());
        return;
    }
    if (subframe.bits >= samples.size() * static_cast<std::size_t>(sample_bits)) {
        out.put(0b00000010, 8);  // verbatim
        for (const std::int32_t value : samples) put_sample(value);
        return;
    }
    out.put(0b00010000 | static_cast<std::uint32_t>(subframe.order) << 1, 8);
    for (std::size_t i = 0; i < subframe.order; ++i) put_sample(samples[i]);
    out.put(0b00, 2);  // Rice parameters of 4 bits
    out.put(static_cast<std::uint32_t>(subframe.partition_order), 4);
    const std::size_t length = samples.size() >> subframe.partition_order;
    std::size_t at = 0;
    for (std::size_t p = 0; p < subframe.parameters.size(); ++p) {
        const int parameter = subframe.parameters[p];
        out.put(static_cast<std::uint32_t>(parameter), 4);
        for (const std::size_t until = (p + 1) * length - subframe.order; at < until; ++at) {
            out.put_zeros(subframe.folded[at] >> parameter);
            out.put(1, 1);
            out.put(subframe.folded[at], parameter);
        }
    }
}

/// One block of both channels; `number` counts frames of the format from 0.
std::string flac_frame(const std::vector<std::int16_t>& samples, std::uint32_t number) {
    const std::size_t count = samples.size() / channels;
    std::array<std::vector<std::int32_t>, 4> signals;  // left, right, middle, side
    for (auto& signal : signals) signal.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::int32_t left = samples[2 * i];
        const std::int32_t right = samples[2 * i + 1];
        signals[0][i] = left;
        signals[1][i] = right;
        signals[2][i] = (left + right) >> 1;
        signals[3][i] = left - right;
    }
    constexpr std::array<int, 4> widths = {16, 16, 16, 17};
    std::array<Subframe, 4> subframes;
    for (std::size_t i = 0; i < 4; ++i) subframes[i] = predicted(signals[i], widths[i]);
    struct Choice {
        std::uint32_t code;
        std::size_t first;
        std::size_t second;
    };
    constexpr std::array<Choice, 4> choices = {{{1, 0, 1}, {8, 0, 3}, {9, 3, 1}, {10, 2, 3}}};
    const Choice& choice = *std::min_element(choices.begin(), choices.end(), [&](const Choice& a, const Choice& b) {
        return subframes[a.first].bits + subframes[a.second].bits <
               subframes[b.first].bits + subframes[b.second].bits;
    });

    Bits out;
    out.put(0xFFF8, 16);                         // blocks of fixed size
    out.put(count == block_frames ? 12 : 7, 4);  // 4096, or 16 bits that follow
    out.put(9, 4);                               // 44.1 kHz
    out.put(choice.code, 4);
    out.put(0b1000, 4);  // 16 bits
    // The number of the frame, coded like a code point of up to 31 bits in UTF-8.
    if (number < 0x80) {
        out.put(number, 8);
    } else {
        int more = 1;
        while (number >> (6 * more + 6 - more) != 0) ++more;
        const std::uint32_t lead = 0xFFU << (7 - more) & 0xFFU;
        out.put(lead | number >> (6 * more), 8);
        for (int i = more - 1; i >= 0; --i) out.put(0x80 | (number >> (6 * i) & 0x3F), 8);
    }
    if (count != block_frames) out.put(static_cast<std::uint32_t>(count - 1), 16);
    out.put(crc(out.bytes(), 8, 0x07), 8);
    for (const std::size_t i : {choice.first, choice.second}) put_subframe(out, signals[i], widths[i], subframes[i]);
    out.fill_byte();
    out.put(crc(out.bytes(), 16, 0x8005), 16);
    return std::move(out.bytes());
}

/// Writes blocks of fixed size, fixed predictors and Rice codes, which every player supports. Source: RFC 9639.
void write_flac(const Rendering& rendering, const Write& write) {
    // The checksum of the samples precedes them.
    Md5 checksum;
    std::string bytes;
    for (Samples samples(rendering);;) {
        const std::vector<std::int16_t>& block = samples.next();
        if (block.empty()) break;
        put_samples(bytes, block);
        checksum.add(bytes);
    }
    Bits head;
    head.bytes() = "fLaC";
    head.put(0x80, 8);  // the last block of metadata, STREAMINFO
    head.put(34, 24);
    head.put(block_frames, 16);
    head.put(block_frames, 16);
    head.put(0, 24);  // sizes of frames are not known
    head.put(0, 24);
    head.put(rate, 20);
    head.put(channels - 1, 3);
    head.put(16 - 1, 5);
    head.put(static_cast<std::uint32_t>(rendering.frames >> 32), 4);
    head.put(static_cast<std::uint32_t>(rendering.frames), 32);
    write(head.bytes());
    write(checksum.finish());
    std::uint32_t number = 0;
    for (Samples samples(rendering);; ++number) {
        const std::vector<std::int16_t>& block = samples.next();
        if (block.empty()) break;
        write(flac_frame(block, number));
    }
}

}  // namespace

std::filesystem::path find_soundfont() {
    if (const char* named = std::getenv("SIKKU_SOUNDFONT"); named && *named != '\0') {
        if (is_readable_file(named)) return named;
        throw std::runtime_error(fmt::format("SIKKU_SOUNDFONT names no file that can be read: {}", named));
    }
    for (const char* folder :
         {"/usr/share/sounds/sf2", "/usr/share/sounds/sf3", "/usr/share/soundfonts", "/usr/local/share/soundfonts"}) {
        std::error_code error;
        std::vector<fs::path> found;
        for (const auto& entry : fs::directory_iterator(folder, error)) {
            const std::string ending = entry.path().extension().string();
            if ((ending == ".sf2" || ending == ".sf3") && is_readable_file(entry.path())) {
                found.push_back(entry.path());
            }
        }
        const auto order = [](const fs::path& path) {
            return std::pair(path.stem() != "default-GM" && path.stem() != "default", path.filename().string());
        };
        std::sort(found.begin(), found.end(),
                  [&](const fs::path& a, const fs::path& b) { return order(a) < order(b); });
        if (!found.empty()) return found.front();
    }
    throw std::runtime_error(
        fmt::format("sound needs a soundfont, and none was found: set SIKKU_SOUNDFONT to one, or {}", advice));
}

double render_audio(const std::filesystem::path& midi, const std::filesystem::path& output, AudioFormat format,
                    const AudioWatch& watch, const std::filesystem::path& given_name) {
    const fs::path& shown = given_name.empty() ? output : given_name;
    const Rendering rendering = render(midi, output, shown, watch);
    const Descriptor file(::open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (file.get() < 0) fail(shown, "write", errno);
    (format == AudioFormat::wav ? write_wav : write_flac)(
        rendering, [&](std::string_view bytes) { write_all(file.get(), bytes.data(), bytes.size(), shown); });
    return rendering.peak;
}

}  // namespace sikku
