#pragma once
#include "../scheduler.h"
