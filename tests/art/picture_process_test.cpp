// tests/art/picture_process_test.cpp: untrusted pictures are decoded in a process that can do nothing else, and
// every failure of it becomes one message.
#include "art/decoder/averager.h"
#include "art/decoder/bare_picture.h"
#include "art/decoder/confinement.h"
#include "art/image/image_file.h"
#include "tests/checks.h"
#include "tests/damaged_pictures.h"
#include "tests/files.h"
#include "tests/fuzz/picture_targets.h"

#include <OpenImageIO/imageio.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace sikku::picture_process_test {

constexpr std::uint64_t most_pixels = 100'000'000;

/// The error of read_picture() for a file, or `WIDTHxHEIGHT`.
std::string answer_to(const std::filesystem::path& path) {
    try {
        const DecodedPicture picture = read_picture(path, 1500, most_pixels);
        return std::to_string(picture.file_width) + "x" + std::to_string(picture.file_height);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
}

std::string answer_to(const std::string& bytes, const std::string& name) {
    const ScratchFolder folder;
    return answer_to(folder.write(name, bytes));
}

/// A picture as OpenImageIO writes it: bands of colour, which coders keep.
std::string coded(const std::string& name, int width, int height, int channels = 3) {
    const ScratchFolder folder;
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < channels; ++c) {
                pixels.push_back(static_cast<std::uint8_t>(c == 3 ? 255 : 30 + 60 * ((x / 16 + c) % 4)));
            }
        }
    }
    const auto output = OIIO::ImageOutput::create(name);
    const OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
    if (!output || !output->open(folder.file(name), spec) ||
        !output->write_image(OIIO::TypeDesc::UINT8, pixels.data()) || !output->close()) {
        return "";
    }
    return contents(folder / name);
}

/// Kilobytes of the largest process that this one started and that has ended.
long peak_of_children() {
    rusage usage{};
    ::getrusage(RUSAGE_CHILDREN, &usage);
    return usage.ru_maxrss;
}
double seconds_of_children() {
    rusage usage{};
    ::getrusage(RUSAGE_CHILDREN, &usage);
    const auto time = [](const timeval& value) {
        return static_cast<double>(value.tv_sec) + 1e-6 * static_cast<double>(value.tv_usec);
    };
    return time(usage.ru_utime) + time(usage.ru_stime);
}

TEST(PictureProcess, ReadsEveryFormat) {
    for (const char* name : {"a.jpg", "a.png", "a.tif", "a.webp", "a.heic", "a.avif", "a.bmp"}) {
        SCOPED_TRACE(name);
        const std::string bytes = coded(name, 67, 45);
        ASSERT_FALSE(bytes.empty());
        const ScratchFolder folder;
        EXPECT_TRUE(is_picture(bytes.substr(0, 64)));
        const DecodedPicture picture = read_picture(folder.write(name, bytes), 1500, most_pixels);
        ASSERT_EQ(picture.width, 67);
        ASSERT_EQ(picture.height, 45);
        ASSERT_EQ(picture.pixels.size(), 3U * 67 * 45);
        // The middle of a band.
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(picture.pixels[3 * (20 * 67 + 24) + c], 30 + 60 * static_cast<int>((1 + c) % 4), 12);
        }
    }
}

TEST(PictureProcess, TransparentPartsLieOnWhite) {
    const ScratchFolder folder;
    for (const char* name : {"a.png", "a.heic"}) {
        std::vector<std::uint8_t> pixels;
        for (int i = 0; i < 64 * 64; ++i)
            pixels.insert(pixels.end(), {0, 0, 0, static_cast<std::uint8_t>(i % 64 < 32 ? 0 : 255)});
        OIIO::ImageSpec spec(64, 64, 4, OIIO::TypeDesc::UINT8);
        const auto output = OIIO::ImageOutput::create(name);
        ASSERT_TRUE(output && output->open(folder.file(name), spec) &&
                    output->write_image(OIIO::TypeDesc::UINT8, pixels.data()) && output->close());
        const DecodedPicture picture = read_picture(folder / name, 100, most_pixels);
        EXPECT_GT(picture.pixels[3 * (64 * 30 + 10)], 240) << name;
        EXPECT_LT(picture.pixels[3 * (64 * 30 + 50)], 15) << name;
    }
}

/// Files can state any size, so only the size of the decoded picture is valid.
TEST(PictureProcess, HeifIsNotLargerThanWhatItCodes) {
    for (const char* name : {"a.heic", "a.avif"}) {
        const std::string sound = coded(name, 64, 64);
        ASSERT_TRUE(has(sound, "ispe"));
        for (const auto& [width, height] : {std::pair(64U, 256U), {9000U, 9000U}, {65U, 64U}}) {
            const std::string answer = answer_to(with_stated_size(sound, width, height), name);
            EXPECT_TRUE(has(answer, "damaged")) << width << " x " << height;
        }
        EXPECT_TRUE(has(answer_to(with_stated_size(sound, 30'000, 30'000), name), "at most 100 million"));
        // libheif 1.19 refuses sizes that are too small as well.
        const std::string smaller = answer_to(with_stated_size(sound, 40, 50), name);
        EXPECT_TRUE(smaller == "40x50" || has(smaller, "does not have the size")) << smaller;
    }
    // Letters in pixel data are not a box.
    std::string letters = coded("a.heic", 64, 64);
    letters += heif_box("free", "ispe" + std::string(4, '\0') + std::string(8, '\x7F'));
    EXPECT_EQ(answer_to(letters, "a.heic"), "64x64");
}

TEST(PictureProcess, HeifThatRefersToItselfIsDamaged) {
    testing::internal::CaptureStderr();
    EXPECT_TRUE(has(answer_to(heif_of_overlays({{1}}, 16), "a.heic"), "damaged"));
    EXPECT_TRUE(has(answer_to(heif_of_overlays({{2}, {1}}, 16), "a.heic"), "damaged"));
    EXPECT_TRUE(has(answer_to(heif_of_overlays({{2}, {}}, 64), "a.heic"), "damaged"));
    // The item that the file says is the picture does not exist: an assertion of the library.
    std::string lost = heif_of_overlays({{2}, {}}, 64);
    const std::size_t list = lost.find("dimg");
    ASSERT_NE(list, std::string::npos);
    for (const char number : {'\0', '\3', '\7'}) {
        lost[list + 9] = number;
        EXPECT_TRUE(has(answer_to(lost, "a.heic"), "damaged"));
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

/// Files of some hundred bytes took gigabytes.
TEST(PictureProcess, MemoryAndTimeAreLimited) {
    if (sanitized) GTEST_SKIP() << "sanitizers reserve terabytes";
    const double before = seconds_of_children();
    const std::string nested = heif_of_overlays({{2}, {3}, {4}, {5}, {}}, 32'700);
    EXPECT_EQ(answer_to(nested, "a.heic"), "the picture needs more than 800 MB of memory");
    EXPECT_EQ(answer_to(heif_of_overlays({{2}, {}}, 32'700), "a.heic"),
              "the picture needs more than 800 MB of memory");
    EXPECT_TRUE(has(answer_to(bmp_file(46'000, 46'000, 1, "\0\1"), "a.bmp"), "46000 x 46000 pixels; at most 100"));
    EXPECT_TRUE(has(answer_to(bmp_file(94, 16'777'122, 1, "\0\1"), "a.bmp"), "at most 100 million"));
    EXPECT_TRUE(has(answer_to(bmp_file(65'536, 65'537, 1, "\0\1"), "a.bmp"), "at most 100 million"));
    EXPECT_TRUE(has(answer_to(bmp_file(-5, 64, 0, "\0\1"), "a.bmp"), "damaged"));
    EXPECT_TRUE(has(answer_to(bmp_file(5, std::numeric_limits<std::int32_t>::min(), 0, "\0\1"), "a.bmp"),
                    "at most 100 million"));
    // Below the limit.
    EXPECT_NE(answer_to(bmp_file(10'000, 9'000, 1, "\0\1"), "a.bmp"), "");
    // Runs that go beyond the last row.
    std::string beyond;
    for (int i = 0; i < 400; ++i) beyond += std::string("\0\2\0\xFF\x40\x41", 6);
    EXPECT_TRUE(has(answer_to(bmp_file(64, 64, 1, beyond), "a.bmp"), "damaged"));
    EXPECT_LT(seconds_of_children() - before, 15);
    EXPECT_LT(peak_of_children(), 1'000'000);
}

TEST(PictureProcess, OneMemoryLimitHoldsForAllLibraries) {
    if (sanitized) GTEST_SKIP() << "sanitizers reserve terabytes";
    // Canvases that grow: each is either read or refused with the limit, and never crashes.
    int refused = 0;
    for (const std::uint32_t side : {6'000U, 9'000U, 12'000U, 18'000U}) {
        const std::string answer = answer_to(heif_of_overlays({{2}, {3}, {}}, side), "a.heic");
        const bool is_limit = answer == "the picture needs more than 800 MB of memory";
        EXPECT_TRUE(is_limit || has(answer, "damaged: ")) << answer;
        EXPECT_FALSE(has(answer, "crashed")) << side;
        refused += is_limit ? 1 : 0;
    }
    EXPECT_GE(refused, 2);
}

TEST(PictureProcess, EndsWhenItsWorkIsStopped) {
    const ScratchFolder folder;
    const std::string path = folder.write("a.jpg", coded("a.jpg", 600, 400));
    struct Counter {
        int calls = 0;
    } counter;
    const Monitor monitor([](void* data) { return ++static_cast<Counter*>(data)->calls > 1; },
                          [](void*, std::uint64_t) {}, &counter);
    EXPECT_THROW(read_picture(path, 1500, most_pixels, monitor), Stopped);
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);  // it was reaped, not only ended
    EXPECT_EQ(errno, ECHILD);
}

TEST(PictureProcess, ReadsRegularFilesOnly) {
    const ScratchFolder folder;
    ASSERT_EQ(::mkfifo(folder.file("pipe").c_str(), 0600), 0);
    EXPECT_EQ(answer_to(folder / "pipe"), "not a regular file");
    EXPECT_EQ(answer_to(folder.path()), "not a regular file");
    EXPECT_EQ(answer_to(std::string(), "empty"), "not a picture: expected JPEG, PNG, TIFF, WebP, HEIF or BMP");
    EXPECT_EQ(answer_to(std::string("axiom: F\n"), "x"),
              "not a picture: expected JPEG, PNG, TIFF, WebP, HEIF or BMP");
}

// --- rights of the process -------------------------------------------------------------------------------------

/// Confines a process and returns the actions that still succeed, a letter for each.
std::string abilities_of_confined() {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) return "no pipe";
    const int parent = ::getpid();
    const ::pid_t child = ::fork();
    if (child == 0) {
        ::dup2(ends[1], STDOUT_FILENO);
        try {
            confine({.memory = 100'000'000, .seconds = 5}, parent);
        } catch (const std::exception&) {
            ::_exit(3);
        }
        const auto tell = [](char letter) {
            if (::write(STDOUT_FILENO, &letter, 1) != 1) ::_exit(4);
        };
        tell('+');
        if (::open("/etc/passwd", O_RDONLY) >= 0) tell('r');
        if (::open("/tmp", O_TMPFILE | O_WRONLY, 0600) >= 0) tell('w');
        if (::socket(AF_UNIX, SOCK_STREAM, 0) >= 0) tell('s');
        if (::socket(AF_INET, SOCK_STREAM, 0) >= 0) tell('i');
        if (const ::pid_t other = ::fork(); other == 0) {
            ::_exit(0);
        } else if (other > 0) {
            tell('f');
        }
        if (::kill(parent, 0) == 0) tell('k');
        if (::unlink("/tmp/none") == 0 || errno == ENOENT) tell('u');
        if (::fcntl(ends[0], F_GETFD) >= 0) tell('d');
        if (void* const memory = std::malloc(200'000'000)) {
            tell('m');
            std::free(memory);
        }
        if (void* const memory = std::malloc(1'000'000)) {
            tell('-');
            std::free(memory);
        }
        char* const words[] = {nullptr};
        ::execve("/bin/true", words, words);
        tell('.');
        ::_exit(0);
    }
    ::close(ends[1]);
    std::string found;
    char letter = 0;
    while (::read(ends[0], &letter, 1) == 1) found += letter;
    ::close(ends[0]);
    int state = 0;
    ::waitpid(child, &state, 0);
    return WIFEXITED(state) && WEXITSTATUS(state) == 0 ? found : found + "!";
}

TEST(Confinement, LeavesOnlyMemoryAndOpenStreams) {
    if (sanitized) GTEST_SKIP() << "sanitizers reserve terabytes";
    EXPECT_EQ(abilities_of_confined(), "+-.");
}

TEST(Confinement, EndsAfterItsProcessorTimeAndWithItsParent) {
    if (sanitized) GTEST_SKIP() << "sanitizers reserve terabytes";
    const int parent = ::getpid();
    ::pid_t child = ::fork();
    if (child == 0) {
        confine({.memory = 100'000'000, .seconds = 1}, parent);
        for (;;) ::getppid();
    }
    int state = 0;
    ASSERT_EQ(::waitpid(child, &state, 0), child);
    EXPECT_TRUE(WIFSIGNALED(state) && WTERMSIG(state) == SIGXCPU);

    // A child with an unexpected parent ends at once.
    child = ::fork();
    if (child == 0) {
        confine({.memory = 100'000'000, .seconds = 1}, parent + 1);
        ::_exit(7);
    }
    ASSERT_EQ(::waitpid(child, &state, 0), child);
    EXPECT_TRUE(WIFEXITED(state) && WEXITSTATUS(state) == 1);
}

// --- parts ------------------------------------------------------------------------------------------------------

TEST(Averager, AveragesOverSquaresOnWhite) {
    // A picture of 5 x 3 in squares of 2: the last column and the last row are left out.
    Averager straight(5, 3, {4, 3, false}, 3);
    const std::array<std::uint8_t, 20> row = {100, 0, 0, 255, 200, 0, 0, 255, 0, 0, 0, 0, 0, 0, 0, 255, 9, 9, 9, 9};
    for (int y = 0; y < 3; ++y) straight.row(row.data());
    const DecodedPicture picture = straight.take(1);
    ASSERT_EQ(picture.width, 2);
    ASSERT_EQ(picture.height, 1);
    EXPECT_EQ(picture.pixels, (std::vector<std::uint8_t>{150, 0, 0, 128, 128, 128}));
    EXPECT_EQ(picture.file_width, 5);
}

TEST(BarePicture, ChecksTheHeadersOfBmp) {
    const std::string sound = bmp_file(8, 2, 0, std::string(16, '\x40'));
    EXPECT_EQ(bare_picture(sound, 100).bytes, sound);
    EXPECT_THROW(bare_picture(sound, 15), std::runtime_error);
    EXPECT_EQ(bare_picture(bmp_file(8, -2, 0, std::string(16, '\x40')), 100).format, std::string("bmp"));
    for (std::size_t length = 0; length < 34; ++length) {
        EXPECT_THROW(bare_picture(sound.substr(0, std::max<std::size_t>(length, 2)), 100), std::runtime_error);
    }
    for (const unsigned compression : {4U, 5U, 100U}) {
        EXPECT_THROW(bare_picture(bmp_file(8, 2, compression, ""), 100), std::runtime_error);
    }
    EXPECT_THROW(bare_picture(bmp_file(8, 2, 0, "", 7), 100), std::runtime_error);
}

// --- damaged files ----------------------------------------------------------------------------------------------

TEST(PictureProcess, DamagedFilesEndInAPictureOrAMessage) {
    const std::vector<std::pair<std::string, std::string>> sound = {
        {"a.heic", coded("a.heic", 64, 64)},
        {"a.avif", coded("a.avif", 64, 64)},
        {"b.heic", coded("b.heic", 70, 40, 4)},
        {"c.heic", heif_of_overlays({{2}, {3}, {}}, 64)},
        {"b.avif", coded("b.avif", 33, 65, 4)},
        {"d.heic", heif_of_overlays({{2, 3, 2}, {}, {}}, 300)},
        {"e.heic", coded("e.heic", 200, 130)},
        {"a.bmp", coded("a.bmp", 31, 17)},
        {"b.bmp", bmp_file(64, 64, 1, std::string("\x40\x41\0\0\x3F\x20\0\2\3\1\0\1", 12))},
        {"c.bmp", bmp_file(20, 9, 0, std::string(200, '\x5A'), 4)}};
    const char* const wanted = std::getenv("SIKKU_DAMAGED_FILES");
    const int count = wanted ? std::atoi(wanted) : std::getenv("SIKKU_FULL") ? 700 : 42;
    std::mt19937 random(12);
    std::map<std::string, int> answers;
    const ScratchFolder folder;
    testing::internal::CaptureStderr();
    for (int i = 0; i < count; ++i) {
        const auto& [name, bytes] = sound[static_cast<std::size_t>(i) % sound.size()];
        const std::string damaged = mutated(bytes, random);
        const std::string answer = answer_to(folder.write(name, damaged));
        EXPECT_FALSE(has(answer, "does not start"));
        EXPECT_FALSE(has(answer, "\n"));
        EXPECT_FALSE(answer.empty());
        ++answers[answer.find(" (signal ") == std::string::npos ? answer.substr(0, 50) : answer];
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_TRUE(sanitized || peak_of_children() < 1'000'000);
    if (!wanted) return;
    for (const auto& [answer, times] : answers) std::printf("%6d  %s\n", times, answer.c_str());
    std::printf("largest process: %ld MB\n", peak_of_children() / 1024);
}

TEST(PictureProcess, TheCorpusGoesThroughTheFuzzTarget) {
    const std::filesystem::path corpus = std::filesystem::path(SIKKU_SOURCE_DIR) / "tests/corpus/pictures";
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
        SCOPED_TRACE(entry.path());
        const std::string bytes = contents(entry.path());
        EXPECT_NO_THROW(try_picture(bytes));
        std::mt19937 random(5);
        // Reading a kolam takes a part of a second.
        const int changes = bytes.starts_with('P') ? 2 : 200;
        for (int i = 0; i < changes; ++i) EXPECT_NO_THROW(try_picture(mutated(bytes, random)));
        ++files;
    }
    EXPECT_GE(files, 12U);
}

}  // namespace sikku::picture_process_test
