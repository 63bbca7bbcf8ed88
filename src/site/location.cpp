#include "site/location.h"
