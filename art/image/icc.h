// art/image/icc.h: converts colours by ICC profiles with lcms2. Part of the module with OpenImageIO.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace sikku {

/// Turns sRGB into the inks of a CMYK profile: relative colorimetric with black point compensation.
class InkTransform {
public:
    /// Safe for untrusted files: loading takes at most 64 MB of memory plus the size of the file.
    /// @throws std::runtime_error, naming the file, if it cannot be read, is not a regular file, exceeds 16 MB, is
    /// not an ICC profile, is damaged, is not CMYK or cannot convert colours to inks
    explicit InkTransform(const std::filesystem::path& file);
    ~InkTransform();
    InkTransform(const InkTransform&) = delete;
    InkTransform& operator=(const InkTransform&) = delete;

    /// The bytes of the file.
    const std::vector<std::uint8_t>& profile() const;
    /// Description of the profile in ASCII; empty if it has none.
    std::string name() const;
    /// True for a profile of an output device, such as a press.
    bool is_of_output() const;
    /// Converts 3 bytes a pixel into 4, 255 for full ink. May be called from several threads at once. Runs of one
    /// colour cost little more than copying.
    void convert(std::span<const std::uint8_t> rgb, std::span<std::uint8_t> inks) const;
    /// Converts one colour, to inks from 0 to 1.
    std::array<double, 4> convert(std::array<std::uint8_t, 3> rgb) const;

private:
    struct Handles;
    std::unique_ptr<Handles> handles_;
};

}  // namespace sikku
