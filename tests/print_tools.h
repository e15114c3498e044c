// tests/print_tools.h: what the tests of prints share: other people's programs, pixels.
#pragma once

#include "art/print/print.h"
#include "art/provenance/provenance.h"
#include "engine/base/output_file.h"
#include "tests/files.h"
#include "tests/tools.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace sikku {

/// A picture as pdftoppm writes it.
struct PixelGrid {
    int width = 0;
    int height = 0;
    std::string bytes;

    Colour at(int x, int y) const {
        const std::size_t i =
            3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
        const auto byte = [&](std::size_t k) { return static_cast<std::uint8_t>(bytes.at(i + k)); };
        return {byte(0), byte(1), byte(2), 255};
    }
};
PixelGrid read_ppm(const std::filesystem::path& path);

/// Three channels of a picture, read by oiiotool. @param is_raw  read ink values without converting them to colours
PixelGrid read_by_oiiotool(const std::filesystem::path& file, const std::string& channels = "R,G,B",
                           bool is_raw = false);

/// Errors that qpdf finds in a PDF.
std::string pdf_complaints(const std::filesystem::path& pdf);

/// A PDF with uncompressed streams; qpdf must find no errors in it.
std::string plain_text(const std::filesystem::path& pdf);

/// The first page of a PDF.
PixelGrid render_pdf(const std::filesystem::path& pdf, int dpi);

/// Channels differ by at most `tolerance`.
::testing::AssertionResult near(Colour actual, Colour expected, int tolerance = 6);

/// One turtle step is a millimetre and (0, 0) is the bottom left corner of a white page of 100 x 60 mm.
Print plain_print();

/// What is read back from a file, or nothing if it is refused.
std::optional<Provenance> provenance_of(const std::filesystem::path& file);

/// Makes a file of `print` with write_svg or write_pdf.
template <typename Make, typename Draw>
void write_print(const std::filesystem::path& path, const Print& print, Make&& make, Draw&& draw) {
    OutputFile file(path);
    const auto writer = make(print, file);
    draw(*writer);
    writer->finish();
    file.commit();
}

/// Something of everything, in an order that is not the order of layers.
void draw_sampler(PathSink& sink);

/// A closed square with its first side in another pen than the others.
void draw_square(PathSink& sink, const Pen& first, const Pen& others);

/// Removes the recipe, which lists the given options, from a text format or a PDF.
std::string without_recipe(const std::string& format, std::string text);

}  // namespace sikku
