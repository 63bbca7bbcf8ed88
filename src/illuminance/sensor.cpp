#include "illuminance/sensor.h"
