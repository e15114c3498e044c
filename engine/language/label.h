// engine/language/label.h: texts that symbols write where the turtle is, such as `label A: A({1}, {2})`.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sikku {

/// The text of a symbol: pieces of text, and parameters of the module.
struct LabelText {
    /// A piece of text, then the value of a parameter, counted from 1; 0: none.
    struct Part {
        std::string text;
        std::uint32_t parameter = 0;
    };
    std::string letter;
    std::vector<Part> parts;

    /// The highest parameter that it shows; 0 if it shows none.
    std::uint32_t parameters() const;
    /// @param arguments  of the module, finite, at least parameters() of them. Whole numbers up to 10^15 are written
    /// in full, others with six digits.
    std::string text(std::span<const double> arguments) const;
};

/// The largest number of bytes in the text of a label.
constexpr std::size_t most_label_bytes = 200;

/// Height of capital letters in steps, if `lettering:` is absent.
constexpr double usual_letter_height = 0.4;

}  // namespace sikku
