#pragma once
#include "outrider/ballistics/target.hpp"
