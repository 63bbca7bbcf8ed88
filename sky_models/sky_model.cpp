#include "sky_models/sky_model.h"
