// Which OpenGL is taken, and what is said when there is none.
#include "visibility/gl_context.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "core/error.h"

namespace tenku {
namespace {

const std::vector<std::string> kAbsent{"libtenku_has_no_such_library.so.1"};

TEST(GlContext, OsMesaGivesOpenGl33OrLater) {
  const GlContext context(GlPlatform::OsMesa);
  EXPECT_EQ(context.platform(), GlPlatform::OsMesa);
  const std::size_t at = context.description().find("OpenGL ");
  ASSERT_NE(at, std::string::npos);
  EXPECT_GE(std::stod(context.description().substr(at + 7)), 3.3) << context.description();
  std::printf("[ MEASURED ] %s\n", context.description().c_str());
}

TEST(GlContext, WithoutEglAutoTakesOsMesa) {
  const GlContext context(GlPlatform::Auto, {.osmesa = GlLibraries{}.osmesa, .egl = kAbsent});
  EXPECT_EQ(context.platform(), GlPlatform::OsMesa);
}

TEST(GlContext, AutoNeverTakesASoftwareRendererOfEgl) {
  const GlContext context(GlPlatform::Auto);
  if (context.platform() == GlPlatform::Egl) {
    EXPECT_EQ(context.description().find("llvmpipe"), std::string::npos) << context.description();
  }
}

TEST(GlContext, WithoutBothThereIsAClearError) {
  try {
    const GlContext context(GlPlatform::Auto, {.osmesa = kAbsent, .egl = kAbsent});
    FAIL() << "a context from nowhere: " << context.description();
  } catch (const ResourceError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("no OpenGL"), std::string::npos) << what;
    EXPECT_NE(what.find(kAbsent[0]), std::string::npos) << what;
  }
}

TEST(GlContext, AForcedPlatformIsNotReplacedByAnother) {
  EXPECT_THROW(GlContext(GlPlatform::Egl, {.osmesa = GlLibraries{}.osmesa, .egl = kAbsent}),
               ResourceError);
  EXPECT_THROW(GlContext(GlPlatform::OsMesa, {.osmesa = kAbsent, .egl = GlLibraries{}.egl}),
               ResourceError);
}

TEST(GlContext, UnknownFunctionsAreRefused) {
  GlContext context(GlPlatform::OsMesa);
  const GlContext::Current current(context);
  EXPECT_NE(context.entry("glDrawArrays"), nullptr);
  EXPECT_THROW((void)context.entry("notAFunctionOfOpenGl"), ResourceError);
}

}  // namespace
}  // namespace tenku
