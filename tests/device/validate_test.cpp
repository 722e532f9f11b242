// Each way in which a batch can be wrong, with the words that name it.

#include "device/validate.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace harpoon {
namespace {

void expect_error(const Batch& batch, Errc code, const char* words) {
  const auto error = validate(batch);
  ASSERT_TRUE(error) << words;
  EXPECT_EQ(error->code, code) << error->message;
  EXPECT_NE(error->message.find(words), std::string::npos) << error->message;
}

TEST(Validate, AcceptsEmptyAndGoodBatches) {
  EXPECT_FALSE(validate(PairBatch<float>{}));
  EXPECT_FALSE(validate(PairArraysBatch<double>{}));
  EXPECT_FALSE(validate(IndexedBatch<float>{}));
  std::vector<SpherePair> pairs(4);
  std::vector<Contact> contacts(5);
  EXPECT_FALSE(validate(PairBatch<float>{pairs, contacts}));
}

TEST(Validate, NamesNullBuffers) {
  std::vector<Contact> contacts(4);
  const SpherePair* none = nullptr;
  expect_error(PairBatch<float>{{none, 4}, contacts}, Errc::invalid_argument, "pairs is null");
  std::vector<double> numbers(4);
  SpherePairArraysOf<double> in{numbers.data(), numbers.data(), numbers.data(),
                                nullptr,        numbers.data(), numbers.data(),
                                numbers.data(), numbers.data(), 4};
  ContactArraysOf<double> out{};
  out.count = 4;
  expect_error(PairArraysBatch<double>{in, out}, Errc::invalid_argument, "pairs.r1 is null");
  in.r1 = numbers.data();
  expect_error(PairArraysBatch<double>{in, out}, Errc::invalid_argument, "contacts.pos_x is null");
}

TEST(Validate, NamesMisalignedBuffers) {
  alignas(8) std::byte bytes[256];
  const auto* odd = reinterpret_cast<const SpherePair*>(bytes + 1);
  std::vector<Contact> contacts(1);
  expect_error(PairBatch<float>{{odd, 1}, contacts}, Errc::invalid_argument,
               "pairs is not aligned to 4");
}

TEST(Validate, NamesOverlappingBuffers) {
  std::vector<SpherePair> memory(8);
  auto* contacts = reinterpret_cast<Contact*>(memory.data() + 3);
  expect_error(PairBatch<float>{{memory.data(), 4}, {contacts, 4}}, Errc::invalid_argument,
               "contacts overlaps pairs");
  contacts = reinterpret_cast<Contact*>(memory.data() + 4);
  EXPECT_FALSE(validate(PairBatch<float>{{memory.data(), 4}, {contacts, 4}}));
}

TEST(Validate, CountsTheContactsThatAreMissing) {
  std::vector<SpherePairF64> pairs(7);
  std::vector<ContactF64> contacts(6);
  const auto error = validate(PairBatch<double>{pairs, contacts});
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code, Errc::capacity);
  EXPECT_EQ(error->needed, 7u);
}

TEST(Validate, RefusesMoreThanTwoToThe31Pairs) {
  const SpherePair one{};
  Contact contact{};
  const std::size_t many = kMaxBatchPairs + 1;
  expect_error(PairBatch<float>{{&one, many}, {&contact, many}}, Errc::batch_too_large, "in parts");
  EXPECT_FALSE(validate(IndexedBatch<float>{}));
}

TEST(Validate, IndexErrorsNameTheOffendingIndex) {
  EXPECT_NE(index_error(12, {3, 9}, 5).message.find("pair 12 names body 9 as g2"),
            std::string::npos);
  EXPECT_NE(index_error(0, {6, 9}, 5).message.find("body 6 as g1"), std::string::npos);
}

}  // namespace
}  // namespace harpoon
