// Devices that do not draw what they are told to: the renderer says so instead of returning a black picture.
#include <map>
#include <string>

#include <halfsilver/error.h>
#include "gpu/tracing_scenes.h"

namespace halfsilver::testing {
namespace {

// GL with other functions under some names.
gl::GetProcAddress with(const gl::GetProcAddress& proc, const std::map<std::string, gl::Proc>& others) {
  return [proc, others](const char* name) {
    const auto other = others.find(name);
    return other != others.end() ? other->second : proc(name);
  };
}

void APIENTRY noDispatch(GLuint, GLuint, GLuint) {}
void APIENTRY noIndirectDispatch(GLintptr) {}
GLenum APIENTRY alwaysReset() { return GL_GUILTY_CONTEXT_RESET; }

class DeviceFailures : public TracingTest {
 protected:
  std::string failureOf(const std::map<std::string, gl::Proc>& others) {
    const Scene scene = soup(20);
    Renderer renderer(with(context.getProcAddress(), others), methods(scene));
    renderer.setScene(scene);
    try {
      drawWith(renderer, kAbove, settingsWith({{"trace.method", "none"}}), 40, 30);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::failed);
      return error.what();
    }
    return "";
  }
};

TEST_F(DeviceFailures, ADeviceThatRunsNothingIsTold) {
  EXPECT_EQ(failureOf({}), "");
  EXPECT_EQ(failureOf({{"glDispatchCompute", reinterpret_cast<gl::Proc>(&noDispatch)},
                       {"glDispatchComputeIndirect", reinterpret_cast<gl::Proc>(&noIndirectDispatch)}}),
            "the device has not run the frame: what its shaders were to write is not there");
}

TEST_F(DeviceFailures, AResetIsTold) {
  EXPECT_EQ(failureOf({{"glGetGraphicsResetStatus", reinterpret_cast<gl::Proc>(&alwaysReset)}}),
            "the device was reset while it drew, and the frame is lost");
}

}  // namespace
}  // namespace halfsilver::testing
