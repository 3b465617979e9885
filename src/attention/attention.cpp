#include "attention/attention.hpp"
