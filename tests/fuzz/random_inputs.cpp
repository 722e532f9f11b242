// A fuzz target as a test, without libFuzzer: the inputs of the corpus, what becomes of them when
// bytes are changed, lost and repeated, and inputs of random bytes. `./dev fuzz` looks further.
//
//   fuzz_NAME SEED INPUTS [CORPUS_FOLDER]

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "support/random.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Input = std::vector<std::uint8_t>;

constexpr std::size_t kMostRandomBytes = 2000;
constexpr std::uint64_t kMostChanges = 8;

std::vector<Input> read_corpus(const char* folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Input> corpus;
  for (const auto& file : files) {
    std::ifstream in(file, std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return corpus;
}

void change(Input& input, harpoon::test::Random& random) {
  const auto at = [&] { return static_cast<std::ptrdiff_t>(random.below(input.size())); };
  for (std::uint64_t left = 1 + random.below(kMostChanges); left > 0 && !input.empty(); --left) {
    const auto place = input.begin() + at();
    switch (random.below(4)) {
      case 0:
        *place = static_cast<std::uint8_t>(random.bits());
        break;
      case 1:
        *place = input[random.below(input.size())];
        break;
      case 2:
        input.erase(place, place + std::min(input.end() - place, at() + 1));
        break;
      default: {
        const Input again(place, place + std::min(input.end() - place, at() + 1));
        input.insert(input.begin() + at(), again.begin(), again.end());
      }
    }
  }
}

Input random_bytes(harpoon::test::Random& random) {
  Input input(random.below(kMostRandomBytes));
  for (std::uint8_t& byte : input) byte = static_cast<std::uint8_t>(random.bits());
  return input;
}

}  // namespace

int main(int count, char** words) {
  if (count < 3) return EXIT_FAILURE;
  harpoon::test::Random random(std::strtoull(words[1], nullptr, 10));
  const auto inputs = std::strtoull(words[2], nullptr, 10);
  const std::vector<Input> corpus = count > 3 ? read_corpus(words[3]) : std::vector<Input>();
  if (count > 3 && corpus.empty()) return EXIT_FAILURE;
  for (const Input& input : corpus) LLVMFuzzerTestOneInput(input.data(), input.size());
  for (unsigned long long k = 0; k < inputs; ++k) {
    Input input;
    if (corpus.empty() || k % 4 == 0) {
      input = random_bytes(random);
    } else {
      input = corpus[random.below(corpus.size())];
      change(input, random);
    }
    LLVMFuzzerTestOneInput(input.data(), input.size());
  }
  std::printf("seed %s: %zu inputs of the corpus and %llu others, no finding\n", words[1],
              corpus.size(), inputs);
  return EXIT_SUCCESS;
}
