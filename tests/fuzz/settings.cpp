// A settings file: settings that their own text gives again, or one line and settings as before.
#include <halfsilver/io.h>
#include "expect.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace halfsilver;
  Settings settings;
  try {
    applySettingsText(settings, {reinterpret_cast<const char*>(data), size}, "a.toml");
    Settings again;
    applySettingsText(again, settingsText(settings), "again.toml");
    fuzz::expect(again == settings, "other settings than those written: " + settingsText(settings));
  } catch (const Error& error) {
    fuzz::expectRefusal(error, "a.toml");
    fuzz::expect(settings == Settings{}, "changed by a file that was refused");
  }
  return 0;
}
