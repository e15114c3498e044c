// art/vector/pdf_x.h: the parts of PDF/X-4: identification, and colours as inks.
#pragma once

#include "art/print/press.h"

#include <map>
#include <string>
#include <string_view>
#include <tuple>

namespace sikku {

/// The colours of a PDF: inks of the press if it has any, else red, green and blue.
class PdfColours {
public:
    /// `press` is kept by reference.
    explicit PdfColours(const Press& press) : press_(press) {}

    std::string_view space() const { return press_.inks ? "DeviceCMYK" : "DeviceRGB"; }
    /// The channels of an opaque colour. Black lines and dots are in black ink alone, since several plates would show
    /// if misaligned; black areas are mixed by the profile.
    const std::string& channels(Colour colour, bool is_drawn);
    /// The operator that sets the colour of lines, or of areas.
    std::string_view set(bool of_lines) const {
        return press_.inks ? (of_lines ? " K" : " k") : (of_lines ? " RG" : " rg");
    }
    /// The channels of unprinted paper.
    std::string_view none() const { return press_.inks ? "0 0 0 0" : "1 1 1"; }

private:
    const Press& press_;
    std::map<std::tuple<int, int, int, bool>, std::string> known_;
};

/// True if a colour of lines and dots is printed in black ink alone.
inline bool is_black_ink(const Press& press, Colour colour, bool is_drawn) {
    return press.inks && is_drawn && colour.red == 0 && colour.green == 0 && colour.blue == 0;
}

/// The entries of the document information that PDF/X-4 requires besides the title. The dates that it requires are
/// the first day of 2010, the year of the standard, so that the same print is the same file on every day.
std::string pdf_x_information();
/// The XMP packet. The title is UTF-8; `id` has 32 hexadecimal digits.
/// Source: ISO 15930-7:2010, 6.8 and 6.9; ISO 16684-1.
std::string pdf_x_metadata(std::string_view title, std::string_view id);

}  // namespace sikku
