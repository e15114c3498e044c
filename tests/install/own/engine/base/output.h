// A header of the consumer with the name of one of Sikku's.
#pragma once

constexpr int own_output = 1;
