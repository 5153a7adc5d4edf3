#include "recording/observed_numbers.h"

#include "recording/codecs.h"

namespace robosim {

std::string ObservedNumber::fullName() const {
  std::string text = name;
  if (index) text += "_" + std::to_string(*index);
  if (*unit.suffix) text += std::string("_") + unit.suffix;
  return text;
}

std::optional<ObservedNumbers> numbersIn(const mrpt::obs::CObservation& observation) {
  ObservedNumbers numbers;
  for (const Codec* codec : codecs()) {
    if (codec->appendNumbers(observation, numbers)) return numbers;
  }
  return std::nullopt;
}

}  // namespace robosim
