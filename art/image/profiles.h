// art/image/profiles.h: the ICC profiles of pictures, as bytes.
#pragma once

#include <string_view>

namespace sikku {

/// The profile of sRGB (IEC 61966-2-1), or of grey with the same curve: ICC version 4, as lcms2 2.14 makes them.
std::string_view srgb_profile();
std::string_view grey_profile();

}  // namespace sikku
