// tests/art/row_deflate_test.cpp: compressed rows, decompressed by zlib.
#include "art/image/row_deflate.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace sikku::row_deflate_test {

/// Decompresses the pieces one after the other, each of which has to come out whole.
void expect_pieces(const std::vector<std::string>& pieces, int level, std::size_t pixel_bytes) {
    RowDeflater deflater(level, pixel_bytes);
    z_stream stream{};
    ASSERT_EQ(inflateInit2(&stream, -15), Z_OK);
    int state = Z_OK;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        std::string packed;
        deflater.compress(pieces[i], i + 1 == pieces.size(), packed);
        std::string again;
        deflater.compress(pieces[i], i + 1 == pieces.size(), again);
        EXPECT_TRUE(again == packed) << "depends on the piece before";
        std::string plain(pieces[i].size() + 1, '\0');
        stream.next_in = reinterpret_cast<Bytef*>(packed.data());
        stream.avail_in = static_cast<uInt>(packed.size());
        stream.next_out = reinterpret_cast<Bytef*>(plain.data());
        stream.avail_out = static_cast<uInt>(plain.size());
        state = inflate(&stream, Z_SYNC_FLUSH);
        plain.resize(plain.size() - stream.avail_out);
        ASSERT_TRUE(plain == pieces[i]) << "level " << level << ", piece " << i << ", "
                                        << (stream.msg ? stream.msg : "");
        ASSERT_EQ(stream.avail_in, 0u);
    }
    EXPECT_EQ(state, Z_STREAM_END);
    inflateEnd(&stream);
}

std::string noise(std::size_t size, unsigned values, unsigned seed) {
    std::mt19937 random(seed);
    std::string bytes;
    while (bytes.size() < size) bytes += static_cast<char>(random() % values);
    return bytes;
}

/// Runs of pixels, of which some repeat the rows before.
std::string rows(std::size_t size, std::size_t pixel_bytes, unsigned seed) {
    std::mt19937 random(seed);
    std::string bytes;
    while (bytes.size() < size) {
        const std::size_t kind = random() % 4;
        const std::size_t count = random() % (kind == 0 ? 2000 : 40);
        if (kind == 1 && bytes.size() > 40'000) {
            bytes += bytes.substr(bytes.size() - random() % 40'000 - 1, count);
        } else {
            const std::string pixel = noise(pixel_bytes, 256, static_cast<unsigned>(random()));
            for (std::size_t i = 0; i <= count; ++i) bytes += pixel;
        }
    }
    bytes.resize(size);
    return bytes;
}

TEST(RowDeflater, ZlibReadsPiecesOfEveryKind) {
    for (int level = 1; level <= 9; ++level) {
        for (const std::size_t pixel_bytes : {1, 3, 4}) {
            std::vector<std::string> pieces = {""};
            for (std::size_t size = 1; size < 12; ++size)
                pieces.push_back(noise(size, 2, static_cast<unsigned>(size)));
            // Runs whose ends are shorter than a match.
            for (std::size_t size = 255; size < 265; ++size) pieces.emplace_back(size, 'a');
            pieces.emplace_back(1'000'000, '\0');
            pieces.push_back(rows(300'000, pixel_bytes, 1));
            pieces.push_back(noise(150'000, 256, 2));  // stored
            pieces.push_back(noise(70'000, 3, 3));
            pieces.push_back(noise(70'000, 40, 4) + rows(70'000, pixel_bytes, 5));
            pieces.emplace_back();
            expect_pieces(pieces, level, pixel_bytes);
        }
    }
}

/// Fibonacci numbers of the bytes make an optimal code longer than deflate allows.
TEST(RowDeflater, LongCodesAreCut) {
    std::string bytes;
    std::size_t count = 1, before = 1;
    for (int value = 0; value < 24; ++value) {
        bytes.append(count, static_cast<char>(value));
        before = std::exchange(count, count + before);
    }
    std::shuffle(bytes.begin(), bytes.end(), std::mt19937(6));
    for (const int level : {1, 6, 9}) expect_pieces({bytes, bytes.substr(0, 30'000)}, level, 4);
}

TEST(RowDeflater, RunsTakeFewBytes) {
    for (const int level : {1, 6}) {
        std::string packed;
        RowDeflater(level, 3).compress(std::string(1'000'000, '\xFF'), true, packed);
        EXPECT_LT(packed.size(), 1100u);
    }
}

TEST(RowDeflater, AdlerIsThatOfZlib) {
    for (const std::size_t size : {0, 1, 15, 16, 17, 4095, 4096, 4097, 5552, 5553, 100'000}) {
        for (const unsigned values : {1U, 256U}) {
            std::string bytes = noise(size, values, 7);
            if (values == 1) bytes.assign(size, '\xFF');
            const auto plain = reinterpret_cast<const Bytef*>(bytes.data());
            EXPECT_EQ(adler32_of(1, bytes), adler32_z(1, plain, size)) << size;
            EXPECT_EQ(adler32_of(0xFFF0'FFF0, bytes), adler32_z(0xFFF0'FFF0, plain, size)) << size;
        }
    }
}

}  // namespace sikku::row_deflate_test
