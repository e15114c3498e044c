#include "art/writer/press_inks.h"

#include "art/image/image_file.h"

#include <memory>

namespace sikku {

void load_inks(Press& press, PrintFormat format) {
    if (press.cmyk.empty() || format != PrintFormat::pdf || press.inks) return;
    const std::shared_ptr<const InkProfile> profile = open_inks(press.cmyk);
    auto inks = std::make_shared<PressInks>();
    inks->profile = profile->bytes();
    inks->name = profile->name();
    inks->convert = [profile](Colour colour) { return profile->convert({colour.red, colour.green, colour.blue}); };
    press.inks = std::move(inks);
}

}  // namespace sikku
