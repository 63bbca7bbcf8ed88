// Broken and hostile Honeybee models: read, or refused with what is wrong in them.
#include <gtest/gtest.h>

#include "tests/robustness/refusal.h"
#include "tests/scene/honeybee_texts.h"

namespace tenku {
namespace {

TEST(HoneybeeRobustness, WholeFileIsReadAndEveryCutOneIsRefused) {
  EXPECT_EQ(refusal_of_text("a.hbjson", kHoneybee), "");
  for (std::size_t length = 0; length < kHoneybee.size(); length += 11) {
    EXPECT_NE(refusal_of_text("a.hbjson", kHoneybee.substr(0, length)), "") << length;
  }
}

TEST(HoneybeeRobustness, WrongModelsAreRefused) {
  for (const auto& [old, with] : std::initializer_list<std::pair<const char*, const char*>>{
           {R"("type":"Model")", R"("type":"Room")"},
           {R"("units":"Meters")", R"("units":7)"},
           {R"("modifiers":[)", R"("modifiers":{},"x":[)"},
           {R"("r_reflectance":0.4)", R"("r_reflectance":1.4)"},
           {R"("r_reflectance":0.4)", R"("r_reflectance":"red")"},
           {R"("refraction_index":null)", R"("refraction_index":0.5)"},
           {R"("rooms":[)", R"("rooms":7,"x":[)"},
           {R"("identifier":"wall")", R"("identifier":7)"},
           {R"("identifier":"wall",)", ""},
           {"[4,0,3],[0,0,3]", "[4,0,1e999],[0,0,3]"},
           {"[4,0,3],[0,0,3]", "[4,0],[0,0,3]"},
           {"[4,0,3],[0,0,3]", R"([4,0,"3"],[0,0,3])"},
           {"[0,0,0],[4,0,0],[4,0,3],[0,0,3]", "[0,0,0],[4,0,0]"},
           {R"("boundary":[[0,0,0])", R"("bounds":[[0,0,0])"}}) {
    EXPECT_NE(refusal_of_text("a.hbjson", replaced(kHoneybee, old, with)), "") << with;
  }
  for (const char* text : {"[]", "{}", "7", "null", "\"Model\""}) {
    EXPECT_NE(refusal_of_text("a.hbjson", text), "") << text;
  }
}

TEST(HoneybeeRobustness, EachByteMayBeWrong) {
  for (std::size_t i = 0; i < kHoneybee.size(); i += 5) {
    for (const char c : {'0', '"', '{', '\xff'}) {
      std::string broken = kHoneybee;
      broken[i] = c;
      refusal_of_text("a.hbjson", broken);
    }
  }
}

}  // namespace
}  // namespace tenku
