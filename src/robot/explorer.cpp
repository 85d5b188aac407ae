#include "outrider/robot/explorer.hpp"  // to see that it stands alone
