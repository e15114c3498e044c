// A plug-in that contains the libraries.
#include <sikku/art/prints.h>
#include <sikku/music/scores.h>

extern "C" int sikku_plugin_formats() {
    return static_cast<int>(sikku::prints().formats().size() + sikku::scores().formats().size());
}
